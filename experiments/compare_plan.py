"""Plan of the task compare: which searches there are to do, in which order."""

from __future__ import annotations

from typing import Any, cast

from omegaconf import DictConfig

from experiments.build import build
from experiments.compare_options import generators, strategies
from experiments.compare_runs import Job, Label
from experiments.compare_study import Study
from experiments.compare_targets import hidden_targets
from experiments.settings import Settings
from experiments.similarities_targets import read_targets
from treefit.mask import Mask
from treefit.objective import View
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Similarity


def plan(cfg: DictConfig, settings: Settings) -> tuple[Study, list[Job]]:
    """Study without any run, and its jobs: repeat by repeat, target by target, so that all optimisers keep abreast."""
    wanted = settings.compare
    similarity = cast(Similarity[Any], build(cfg.similarity, "similarity"))
    wishes = cast(Characteristics, build(cfg.characteristics, "characteristics"))
    view = cast(View, build(cfg.view, "view"))
    searches, growing = strategies(wanted), generators(wanted)
    pictures = read_targets(wanted.masks, cfg.mask, "compare.masks")
    targets: dict[str, dict[str, Mask]] = {
        name: pictures | hidden_targets(generator, similarity, wishes, view, wanted.hidden, settings.seed)
        for name, (generator, _) in growing.items()
    }
    jobs = []
    for repeat in range(wanted.repeats):
        for place in range(len(pictures) + wanted.hidden):
            for name, (generator, words) in growing.items():
                target, mask = list(targets[name].items())[place]
                jobs += [Job(Label(name, target, optimizer, repeat), mask, generator, words, searches[optimizer],
                             similarity, wishes, view, settings.seed + repeat, settings.other_seeds)
                         for optimizer in wanted.optimizers_on(name)]  # fmt: skip
    recipes = {name: _words(str(strategy), wanted.evaluations) for name, strategy in searches.items()}
    versions = {name: f"{generator.name} {generator.version}" for name, (generator, _) in growing.items()}
    return Study(wanted, recipes, versions, settings.seed, settings.other_seeds, len(jobs), []), jobs


def _words(recipe: str, evaluations: int) -> str:
    """Return the settings of a strategy without the evaluations, which all have."""
    return recipe.replace(f"evaluations={evaluations}, ", "").replace(f"evaluations={evaluations}", "")
