"""Candidates: how good a genome is on its seed and on others."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from treefit.candidates import REPORT_HEIGHT, judge
from treefit.fit import aim
from treefit.objective import Objective
from treefit.plant import Budget, Generator, ParameterSpace, Plant, Preset, Value
from treefit.plant.characteristics import Characteristics
from treefit.similarity import PaperSimilarity
from treefit.similarity.measures import agreement, mean_agreement
from treefit.view import OrthographicView, sample

TARGET = blob(256, 256)


@dataclass(frozen=True)
class OneSeed:
    """SimpleGen that only grows on seed 0."""

    name: str = "one_seed"
    version: str = "1"
    parallel: str = "threads"
    pure: bool = True
    size_parameter: str | None = None
    age_parameter: str | None = None
    family: Path | None = None
    presets: ClassVar[Mapping[str, Preset]] = {}
    space: ParameterSpace = field(default_factory=lambda: SimpleGen().space)

    def __call__(self, values: Mapping[str, Value], seed: int, budget: Budget) -> Plant:
        if seed:
            raise RuntimeError("only once")
        return SimpleGen()(values, seed, budget)


def objective(generator: Generator) -> Objective:
    wishes = Characteristics(vertices=2000)
    return aim(TARGET, generator, PaperSimilarity(), wishes, OrthographicView(64), 0)


def test_other_seeds_are_judged_as_the_seed_of_the_search_is() -> None:
    goal = objective(SimpleGen())
    genome = goal.space.encode(goal.space.complete({}))
    found = judge(goal, genome, TARGET, 2)
    others = [judge(goal.on(seed), genome, TARGET, 0) for seed in (1, 2)]
    assert found.score_other_seeds == pytest.approx(np.mean([other.score.total for other in others]))
    assert found.agreement_other_seeds == mean_agreement([other.agreement for other in others])
    assert others[0].score_other_seeds is others[0].agreement_other_seeds is None


def test_the_agreement_is_that_of_the_mask_that_is_reported() -> None:
    goal = objective(SimpleGen())
    found = judge(goal, goal.space.encode(goal.space.complete({})), TARGET, 0)
    assert found.mask.shape[0] == REPORT_HEIGHT
    assert found.agreement == agreement(sample(TARGET, goal.frame.finer(REPORT_HEIGHT)), found.mask)


def test_a_plant_that_fails_on_another_seed_counts_as_nothing_there() -> None:
    goal = objective(OneSeed())
    found = judge(goal, goal.space.encode(goal.space.complete({})), TARGET, 2)
    assert found.score.total > 0
    assert found.score_other_seeds == 0
    assert found.agreement_other_seeds is not None
    assert found.agreement_other_seeds.silhouette_iou == found.agreement_other_seeds.texture == 0
    assert found.agreement_other_seeds.contour_distance == 100
