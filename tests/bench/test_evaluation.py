"""Speed of the way of one evaluation, part by part, on a tree of about 5,000 vertices: `make bench`."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from tests.conftest import blob
from treefit.fit import aim
from treefit.objective import Objective
from treefit.plant import Budget, Plant, check_plant
from treefit.plant.characteristics import Characteristics
from treefit.search import TreeGA
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView

pytest.importorskip("pytest_benchmark")

VALUES = {"branch_count_0": 15, "whorl": 4, "branch_count_1": 6, "branch_count_2": 4, "branch_count_3": 3,
          "leaf_number": 3, "leaves_count": 0.9}  # fmt: skip


@pytest.fixture(scope="module")
def objective() -> Objective:
    wishes = Characteristics(vertices=5000)
    return aim(blob(256, 256), SimpleGen(), PaperSimilarity(), wishes, OrthographicView(), 0)


@pytest.fixture(scope="module")
def plant(objective: Objective) -> Plant:
    return objective.generator(objective.generator.space.complete(VALUES), 0, objective.budget)


def test_generate(benchmark: Any, objective: Objective) -> None:
    values = objective.generator.space.complete(VALUES)
    plant = benchmark(objective.generator, values, 0, objective.budget)
    benchmark.extra_info.update(vertices=plant.n_vertices, leaves=plant.n_leaves)


def test_generate_an_aspen(benchmark: Any) -> None:
    generator = WeberPennGen()
    aspen = generator.presets["quaking_aspen"]
    plant = benchmark(generator, generator.space.complete(aspen.values), aspen.seed, Budget())
    benchmark.extra_info.update(vertices=plant.n_vertices, leaves=plant.n_leaves)


def test_check(benchmark: Any, plant: Plant) -> None:
    benchmark(check_plant, plant)


def test_view(benchmark: Any, objective: Objective, plant: Plant) -> None:
    benchmark(objective.view, plant, objective.frame)


def test_view_of_four_sides(benchmark: Any, objective: Objective, plant: Plant) -> None:
    benchmark(OrthographicView(azimuths=4).sides, plant, objective.frame)


def test_describe(benchmark: Any, objective: Objective, plant: Plant) -> None:
    benchmark(objective.similarity.describe, objective.view(plant, objective.frame))


def test_compare(benchmark: Any, objective: Objective, plant: Plant) -> None:
    described = objective.similarity.describe(objective.view(plant, objective.frame))
    benchmark(objective.similarity.compare, objective.target, described)


def test_whole_evaluation(benchmark: Any, objective: Objective) -> None:
    space = objective.space
    score = benchmark(objective, space.encode({name: v for name, v in VALUES.items() if name in space.names}))
    assert score.failure is None


def test_optimizer(benchmark: Any) -> None:
    search = TreeGA().begin(38, 0)

    def step() -> None:
        search.tell(np.random.default_rng(0).random(len(search.ask())))

    benchmark.pedantic(step, rounds=20)
