"""Speed of the protocol of foreign programs on a tree of 5,000 vertices and 10,000 leaves, part by part: `make bench`.

What it costs is a whole call less the program's own work: the pipe, the file written and read, the checks of the tree.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from generators.external import External
from generators.external.arrays import plant_of
from generators.external.digest import digest
from generators.external.npz import read_npz
from tests.generators.external.hostile.tree import grow
from treefit.plant import Budget, Values

pytest.importorskip("pytest_benchmark")

FOLDER = Path(__file__).parents[1] / "generators" / "external"
VALUES: Values = {"height": 10.0, "branches": 998, "angle": 70.0, "reach": 0.3, "leaf_size": 0.4}
BUDGET, ROUNDS = Budget(6_000, 12_000), 300


@pytest.fixture(scope="module")
def external() -> Iterator[External]:
    generator = External(
        command=[sys.executable, str(FOLDER / "tree_program.py")], space=FOLDER / "hostile" / "space.yaml"
    )
    yield generator
    generator.close()


@pytest.fixture(scope="module")
def arrays() -> dict[str, Any]:
    return grow(dict(VALUES), 0)


@pytest.fixture
def file(arrays: dict[str, Any], tmp_path: Path) -> Path:
    np.savez(tmp_path / "tree.npz", **arrays)
    return tmp_path / "tree.npz"


def test_whole_call(benchmark: Any, external: External) -> None:
    plant = benchmark.pedantic(external, (VALUES, 0, BUDGET), rounds=ROUNDS, warmup_rounds=5)
    benchmark.extra_info.update(vertices=plant.n_vertices, leaves=plant.n_leaves)
    assert (plant.n_vertices, plant.n_leaves) == (5002, 9980)


def test_own_work_of_the_program(benchmark: Any) -> None:
    benchmark.pedantic(grow, (VALUES, 0), rounds=ROUNDS, warmup_rounds=5)


def test_round_trip_of_a_line(benchmark: Any, external: External) -> None:
    assert benchmark.pedantic(external.ask_preset, rounds=ROUNDS, warmup_rounds=5)["branches"] == 40


def test_write_npz(benchmark: Any, arrays: dict[str, Any], tmp_path: Path) -> None:
    names = (tmp_path / f"tree-{i}.npz" for i in count())  # to write over a file may wait for the disk

    def write() -> None:
        np.savez(next(names), **arrays)

    benchmark.pedantic(write, rounds=ROUNDS, warmup_rounds=5)


def test_read_npz(benchmark: Any, file: Path) -> None:
    assert len(benchmark.pedantic(read_npz, (file, 200_000), rounds=ROUNDS, warmup_rounds=5)) == 8


def test_arrays_become_a_plant(benchmark: Any, file: Path) -> None:
    arrays = read_npz(file, 200_000)
    assert benchmark.pedantic(plant_of, (arrays,), rounds=ROUNDS, warmup_rounds=5).n_vertices == 5002


def test_digest(benchmark: Any, arrays: dict[str, Any]) -> None:
    benchmark.pedantic(digest, (plant_of(arrays),), rounds=ROUNDS, warmup_rounds=5)
