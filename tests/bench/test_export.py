"""Speed of the files of a tree of 5,000 and of 50,000 vertices with twice as many leaves: `make bench`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.asset.conftest import make_tree
from treefit.asset import AssetSettings, write_glb, write_tree
from treefit.plant import Plant

pytest.importorskip("pytest_benchmark")

TREES = {"5k": (36, 33, 10_000), "50k": (120, 103, 100_000)}
"""Branches, twigs a branch, leaves."""


@pytest.fixture(scope="module", params=TREES)
def plant(request: pytest.FixtureRequest) -> Plant:
    branches, twigs, leaves = TREES[request.param]
    return make_tree(branches=branches, twigs=twigs, leaves=leaves)


def test_glb_of_the_whole_model(benchmark: Any, plant: Plant, tmp_path: Path) -> None:
    path = tmp_path / "tree.glb"
    counts = benchmark.pedantic(write_glb, (plant, path, AssetSettings()), rounds=3, warmup_rounds=1)
    benchmark.extra_info.update(vertices=plant.n_vertices, leaves=plant.n_leaves, triangles=counts.triangles,
                                megabytes=path.stat().st_size / 1e6)  # fmt: skip
    assert plant.n_leaves == 2 * round(plant.n_vertices, -3)


def test_all_levels(benchmark: Any, plant: Plant, tmp_path: Path) -> None:
    files = benchmark.pedantic(write_tree, (tmp_path, plant, AssetSettings()), rounds=1, warmup_rounds=1)
    sizes = {name: (tmp_path / name).stat().st_size / 1e6 for name in files.names}
    benchmark.extra_info.update(vertices=plant.n_vertices, leaves=plant.n_leaves, megabytes=sizes)
    assert len(files.levels) == 4
