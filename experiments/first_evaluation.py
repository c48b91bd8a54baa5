"""One evaluation and no more, to be timed as a process of its own: `python -m experiments.first_evaluation FILE`."""

from __future__ import annotations

import sys
from typing import Any, cast

import numpy as np
from omegaconf import DictConfig, OmegaConf

from experiments.build import build
from treefit.fit import aim
from treefit.mask import BRANCH
from treefit.objective import View
from treefit.plant import Generator
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Similarity


def main(config: str) -> None:
    """Evaluate the middle of the search space with the settings in the file `config`, aiming at a post."""
    cfg = cast(DictConfig, OmegaConf.load(config))
    generator = cast(Generator, build(cfg.generator, "generator"))
    similarity = cast(Similarity[Any], build(cfg.similarity, "similarity"))
    view = cast(View, build(cfg.view, "view"))
    post = np.full((256, 64), BRANCH, np.uint8)
    objective = aim(post, generator, similarity, Characteristics(), view, 0)
    objective(np.full(len(objective.space), 0.5))


if __name__ == "__main__":
    main(sys.argv[1])
