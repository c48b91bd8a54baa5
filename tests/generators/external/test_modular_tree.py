"""modular-tree as a generator; skipped where the package is not installed."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageDraw

import generators.external.modular_tree as adapter
from generators.external.arrays import plant_of
from generators.external.space import read_space
from treefit.plant import Budget, Value, Values, read_presets
from treefit.view import Frame, OrthographicView

pytestmark = pytest.mark.slow  # an extra

HOME = Path(adapter.__file__).parent
SPACE = read_space(HOME / "space.yaml")
PRESETS = read_presets(HOME / "presets")
needs_package = pytest.mark.skipif(not adapter.installed(), reason=f"needs the package {adapter.PACKAGE}")

ROWS = 2048  # of silhouettes

Arrays = Mapping[str, NDArray[np.float32] | NDArray[np.int32]]


def grow(values: Values, seed: int) -> Arrays:
    """Arrays of a tree, grown in this process."""
    arrays: Arrays = import_module("generators.external.modular_tree.program").grow(values, seed)
    return arrays


def digest(values: Values, seed: int) -> str:
    """Digest of all bytes of a tree."""
    return hashlib.sha256(b"".join(np.ascontiguousarray(a).tobytes() for a in grow(values, seed).values())).hexdigest()


def random_values(count: int) -> list[dict[str, Value]]:
    """Values of `count` random genomes."""
    rng = np.random.default_rng(9)
    return [SPACE.decode(rng.random(len(SPACE))) for _ in range(count)]


@needs_package
def test_same_seed_is_the_same_bytes_and_another_seed_another_tree() -> None:
    oak = SPACE.complete(PRESETS["oak"].values)
    assert digest(oak, 5) == digest(oak, 5)
    assert len({digest(oak, seed) for seed in (0, 1, 2, 5, 3 << 40, 2**63 - 1)}) == 6


@needs_package
def test_random_genomes_are_trees_of_a_sensible_size() -> None:
    plants = [plant_of(grow(values, seed)) for seed, values in enumerate(random_values(100))]  # checks each of them
    nodes, leaves = np.array([[plant.n_vertices, plant.n_leaves] for plant in plants]).T
    assert nodes.min() > 150
    assert nodes.max() < 30_000
    assert leaves.min() > 50
    assert leaves.max() < 50_000
    assert np.percentile(nodes, 95) < 8_000


@needs_package
def test_stems_stand_on_the_axes_of_their_parents() -> None:
    for seed, values in enumerate(random_values(12)):
        plant = plant_of(grow(values, seed))
        feet = np.flatnonzero(plant.level[1:] > plant.level[plant.parent[1:]]) + 1
        under = plant.parent[feet]
        assert np.array_equal(plant.level[feet], plant.level[under] + 1)
        assert np.array_equal(plant.parent[under + 1], under)  # the parent's stem goes on behind its node
        start, end = (plant.position[at].astype(float) for at in (under, under + 1))
        along = np.clip(((plant.position[feet] - start) * (end - start)).sum(1) / ((end - start) ** 2).sum(1), 0, 1)
        apart = np.linalg.norm(start + along[:, None] * (end - start) - plant.position[feet], axis=1)
        assert apart.max() < 3e-5


@pytest.mark.slow
@needs_package
def test_skeleton_has_the_silhouette_of_the_mesh_where_pixels_can_show_it() -> None:
    compared = 0
    for seed, values in enumerate(random_values(6)):
        plant = plant_of(grow(values, seed))
        if np.median(plant.radius) > 0.5 * plant.position[:, 2].max() / ROWS:  # the view widens wood under a pixel
            skeleton, mesh = silhouettes(values, seed)
            assert (skeleton & mesh).sum() > 0.95 * (skeleton | mesh).sum()
            compared += 1
    assert compared >= 3


@needs_package
@pytest.mark.parametrize("name", sorted(PRESETS))
def test_preset_is_a_tree_of_its_own_kind(name: str) -> None:
    plant = plant_of(grow(SPACE.complete(PRESETS[name].values), PRESETS[name].seed))
    width = np.ptp(plant.leaf_position[:, :2], axis=0).max() / plant.position[:, 2].max()
    low, high = {"birch": (0.35, 0.6), "oak": (0.9, 1.4), "pine": (0.3, 0.6), "poplar": (0.15, 0.35)}.get(
        name, (0.4, 0.7)
    )
    assert low < width < high
    assert 1_000 < plant.n_vertices < 8_000
    assert 2_000 < plant.n_leaves < 15_000


@needs_package
def test_scale_is_the_size_and_nothing_else() -> None:
    values = SPACE.complete({})
    one, two = (plant_of(grow({**values, "scale": scale}, 1)) for scale in (1.0, 2.0))
    for field in ("position", "radius", "leaf_position", "leaf_size"):
        assert np.array_equal(2 * getattr(one, field), getattr(two, field))
    assert np.array_equal(one.leaf_axis, two.leaf_axis)


@needs_package
def test_density_of_zero_is_a_tree_in_winter() -> None:
    assert plant_of(grow(SPACE.complete({"leaves.density": 0.0}), 1)).n_leaves == 0


@needs_package
def test_every_searched_parameter_changes_the_tree() -> None:
    usual = SPACE.complete({})
    seen = digest(usual, 1)
    ends = {p.name: p.choices[0] if p.kind == "choice" else p.low for p in SPACE.free}
    assert [name for name, end in ends.items() if digest({**usual, name: end}, 1) == seen] == []


def test_missing_package_is_told_with_the_command_that_installs_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(adapter, "find_spec", lambda _: None)
    with pytest.raises(ValueError, match=r'not installed; install it by: pip install "treefit\[modular-tree\]"$'):
        adapter.modular_tree()


@pytest.mark.slow
@needs_package
def test_child_process_grows_the_same_bytes() -> None:
    generator = adapter.modular_tree()
    try:
        birch = generator.presets["birch"]
        values = generator.space.complete(birch.values)
        found, wanted = generator(values, birch.seed, Budget()), plant_of(grow(values, birch.seed))
        for field in (
            "position",
            "radius",
            "parent",
            "level",
            "leaf_position",
            "leaf_axis",
            "leaf_normal",
            "leaf_size",
        ):
            assert getattr(found, field).tobytes() == getattr(wanted, field).tobytes()
    finally:
        generator.close()


def silhouettes(values: Values, seed: int) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Wood of the plant as the view draws it, and the package's own mesh seen from the same side, filled."""
    program, m_tree = import_module("generators.external.modular_tree.program"), import_module("m_tree")
    plant = plant_of(grow({**values, "leaves.density": 0.0}, seed))
    top, reach = plant.position[:, 2].max(), np.abs(plant.position[:, 0]).max()
    fine = 8  # PIL's polygons are half a pixel too large all around
    frame = Frame(ROWS, int(np.ceil(2 * (reach / top + 0.1) * ROWS / 64)))
    mesh = m_tree.BasicMesher().mesh_tree(program.tree_of(values, seed))
    corners, scale = mesh.get_vertices().reshape(-1, 3), frame.height * fine / top
    seen = np.stack([frame.width * fine / 2 + corners[:, 0] * scale, (top - corners[:, 2]) * scale], axis=1) - 0.5
    drawn = Image.new("L", (frame.width * fine, frame.height * fine))
    for face in seen[mesh.get_polygons().reshape(-1, 4)].reshape(-1, 8).tolist():
        ImageDraw.Draw(drawn).polygon(face, fill=255)
    share = np.asarray(drawn.reduce(fine))
    return OrthographicView()(plant, frame).unpack() > 0, share >= 128
