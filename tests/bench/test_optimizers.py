"""Own time of the optimizers: a generation of ask and tell with 36 genes, us a genome in extra_info: `make bench`."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hydra.utils import instantiate
from omegaconf import OmegaConf

from treefit.search import Hints
from treefit.search.optimizer import Strategy

pytest.importorskip("pytest_benchmark")

CONF = Path(__file__).parents[2] / "conf" / "optimizer"
GENES = 36
TOP = np.random.default_rng(1).random(GENES)


def hints() -> Hints:
    """Hints with rates and marks that say something, as those of a family do."""
    rng, nothing = np.random.default_rng(0), Hints.none(GENES)
    return Hints(nothing.known, rng.random(GENES), rng.normal(size=(GENES, 10)), nothing.guess, nothing.spread)


@pytest.mark.parametrize("name", sorted(path.stem for path in CONF.glob("*.yaml")))
def test_own_time(benchmark: Any, name: str) -> None:
    strategy: Strategy = instantiate(OmegaConf.load(CONF / f"{name}.yaml"), evaluations=10_000)
    search, spent, genomes = strategy.begin(GENES, 0, hints()), 0.0, 0

    def step() -> None:
        nonlocal spent, genomes
        began = time.process_time()
        asked = search.ask()
        search.floors()
        search.tell(np.exp(-((asked - TOP) ** 2).sum(axis=1)))
        spent, genomes = spent + time.process_time() - began, genomes + len(asked)

    step()  # what is imported and compiled first
    spent, genomes = 0.0, 0
    benchmark.pedantic(step, rounds=20)
    benchmark.extra_info.update(us_a_genome=round(1e6 * spent / genomes, 1))
