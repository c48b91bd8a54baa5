"""Speed of GEGen: growth of a tree of about 6,000 vertices, and whole evaluations of one of 3,000: `make bench`."""

from __future__ import annotations

from typing import Any

import pytest

from generators.gegen import GEGen
from tests.conftest import blob
from treefit.fit import aim
from treefit.plant import Budget, Value
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Mix
from treefit.view import OrthographicView

pytest.importorskip("pytest_benchmark")

GENERATOR = GEGen()
LARGE: dict[str, Value] = {"internodes": 6800, "shedding": 0.03}
MIDDLING: dict[str, Value] = {"internodes": 3400, "shedding": 0.03}


def test_grow(benchmark: Any) -> None:
    plant = benchmark(GENERATOR, GENERATOR.space.complete(LARGE), 0, Budget(20_000, 80_000))
    benchmark.extra_info.update(vertices=plant.n_vertices, leaves=plant.n_leaves)
    assert 5_000 < plant.n_vertices < 7_000


def test_whole_evaluation(benchmark: Any) -> None:
    wishes = Characteristics(vertices=3000)
    objective = aim(blob(256, 256), GENERATOR, Mix(), wishes, OrthographicView(), 0)
    values = GENERATOR.space.complete(MIDDLING)
    plant = GENERATOR(values, 0, objective.budget)
    benchmark.extra_info.update(vertices=plant.n_vertices, leaves=plant.n_leaves)
    assert 2_500 < plant.n_vertices < 3_500
    genome = objective.space.encode({name: value for name, value in values.items() if name in objective.space.names})
    assert benchmark(objective, genome).failure is None
