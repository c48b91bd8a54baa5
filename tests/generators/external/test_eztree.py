from __future__ import annotations

import json
import subprocess
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from generators.external import External
from generators.external import eztree as adapter
from generators.external.eztree import eztree
from treefit.plant import Budget, Plant, Value, check_plant
from treefit.plant.extent import extent_of
from treefit.view import Frame, OrthographicView


def missing() -> str | None:
    """Why trees of ez-tree cannot be grown here; None when they can."""
    try:
        eztree().close()
    except ValueError as error:
        return str(error)
    return None


pytestmark = [pytest.mark.slow, pytest.mark.node, pytest.mark.skipif(missing() is not None, reason=str(missing()))]

MESH = Path(__file__).parent / "eztree_mesh.mjs"
BUDGET = Budget(1_000_000, 1_000_000)
FIELDS = ("position", "radius", "parent", "level", "leaf_position", "leaf_axis", "leaf_normal", "leaf_size")
PRESETS = ("oak_medium", "pine_medium")
CORNERS = 16  # of a ring of the meshes: nearly a circle
ROWS, FINER = 1024, 4  # rows of a mask in which most twigs are wider than a pixel; pixels of the mesh's own in one
Mesh = Mapping[str, NDArray[np.float32]]


@pytest.fixture(scope="module")
def generator() -> Iterator[External]:
    made = eztree()
    yield made
    made.close()


def random_values(generator: External, count: int) -> list[dict[str, Value]]:
    rng = np.random.default_rng(3)
    return [generator.space.decode(rng.random(len(generator.space))) for _ in range(count)]


def preset(generator: External, name: str) -> tuple[dict[str, Value], int, Plant]:
    """Values and seed of a preset, and its plant."""
    found = generator.presets[name]
    values = generator.space.complete(found.values)
    return values, found.seed, generator(values, found.seed, BUDGET)


def mesh_of(values: Mapping[str, Value], seed: int, folder: Path) -> Mesh:
    """The package's own mesh: vertices (3, n) of wood and leaves in metres, triangles (3, m)."""
    corners = {f"branch.segments.{level}": CORNERS for level in range(4)}
    request = json.dumps({"values": {**values, **corners}, "seed": seed, "out": str(folder / "mesh.npz")})
    subprocess.run(["node", str(MESH)], input=request, text=True, check=True)
    with np.load(folder / "mesh.npz") as arrays:
        return dict(arrays)


def test_same_input_gives_the_same_bytes_also_from_another_process(generator: External) -> None:
    values = random_values(generator, 1)[0]
    other = eztree()
    try:
        plants = [each(values, 7, BUDGET) for each in (generator, generator, other)]
    finally:
        other.close()
    for name in FIELDS:
        assert len({getattr(plant, name).tobytes() for plant in plants}) == 1


def test_seeds_give_different_trees_also_beyond_32_bits(generator: External) -> None:
    values = random_values(generator, 1)[0]
    seen = {generator(values, seed, BUDGET).position.tobytes() for seed in (0, 1, 2, 70_000, 2**32 - 1)}
    assert len(seen) == 5
    assert generator(values, 2**63 - 1, BUDGET).n_vertices > 1


def test_random_genomes_grow_valid_trees_of_a_size_that_a_search_can_bear(generator: External) -> None:
    plants = [generator(values, 5, BUDGET) for values in random_values(generator, 30)]
    for plant in plants:
        check_plant(plant)
        assert (plant.position[0] == 0).all()
        assert set(np.unique(plant.level[1:] - plant.level[plant.parent[1:]])) <= {0, 1}
    assert sum(plant.n_vertices > 20_000 for plant in plants) <= 2
    assert 300 <= np.median([plant.n_vertices for plant in plants]) <= 8_000


def test_presets_grow_at_plausible_heights(generator: External) -> None:
    heights = {name: extent_of(preset(generator, name)[2]).height for name in generator.presets}
    assert len(heights) >= 8
    assert 3 < min(heights.values()) <= max(heights.values()) < 30
    assert heights["bush_3"] < 7 < heights["oak_medium"] < heights["oak_large"]


def test_metres_scale_wood_and_leaves_and_nothing_else(generator: External) -> None:
    values, seed, plant = preset(generator, "ash_medium")
    twice = generator({**values, "metres": 2 * float(values["metres"])}, seed, BUDGET)
    for name in ("position", "radius", "leaf_position", "leaf_size"):
        np.testing.assert_allclose(getattr(twice, name), 2 * getattr(plant, name), rtol=1e-6)
    np.testing.assert_array_equal(twice.leaf_axis, plant.leaf_axis)


def test_vertices_are_the_rings_of_the_packages_own_mesh(generator: External, tmp_path: Path) -> None:
    for name in PRESETS:
        values, seed, plant = preset(generator, name)
        corners = mesh_of(values, seed, tmp_path)["wood"].reshape(3, -1, CORNERS + 1)
        centres = corners[:, :, :-1].mean(axis=2)
        radii = np.linalg.norm(corners[:, :, 0] - centres, axis=0)
        rings, vertices = np.vstack([centres, radii]).T, np.column_stack([plant.position, plant.radius])
        apart = np.abs(rings[:, None] - vertices).max(axis=2)
        assert apart.min(axis=0).max() < 1e-4
        assert apart.min(axis=1).max() < 1e-4


def test_leaves_are_the_quads_of_the_packages_own_mesh(generator: External, tmp_path: Path) -> None:
    values, seed, plant = preset(generator, "oak_medium")
    corners = mesh_of(values, seed, tmp_path)["leaves"].T.reshape(-1, 2, 4, 3).swapaxes(0, 1).reshape(-1, 4, 3)
    top, foot = corners[:, [0, 3]].mean(axis=1), corners[:, [1, 2]].mean(axis=1)
    width = corners[:, 2] - corners[:, 1]
    np.testing.assert_allclose(plant.leaf_position, foot, atol=1e-5)
    np.testing.assert_allclose(plant.leaf_axis * plant.leaf_size[:, :1], top - foot, atol=1e-5)
    np.testing.assert_allclose(plant.leaf_size[:, 1], np.linalg.norm(width, axis=1), rtol=1e-4)
    np.testing.assert_allclose((plant.leaf_normal * width).sum(axis=1), 0, atol=1e-5)


def test_stems_begin_on_the_axis_of_their_parent(generator: External) -> None:
    for name in PRESETS:
        plant = preset(generator, name)[2]
        parent = np.maximum(plant.parent, 0)
        goes_on = np.flatnonzero(plant.level == plant.level[parent])[1:]
        after = np.full(plant.n_vertices, -1)
        after[parent[goes_on]] = goes_on
        new = np.flatnonzero(plant.level > plant.level[parent])
        a, b = plant.position[parent[new]], plant.position[after[parent[new]]]
        way = [np.linalg.norm(q - p, axis=1) for p, q in ((a, plant.position[new]), (plant.position[new], b), (a, b))]
        np.testing.assert_allclose(way[0] + way[1], way[2], atol=1e-4)


def test_the_mask_of_the_wood_is_that_of_the_packages_own_triangles(generator: External, tmp_path: Path) -> None:
    values, seed, plant = preset(generator, "ash_medium")
    assert silhouette_iou(plant, mesh_of(values, seed, tmp_path)) > 0.94


def silhouette_iou(plant: Plant, mesh: Mesh) -> float:
    """Intersection over union of the wood of `plant` as a mask and of the triangles of `mesh`."""
    none = {name: getattr(plant, name)[:0] for name in FIELDS[4:]}
    bare = replace(plant, **none)
    height = extent_of(bare).height
    window = Frame(ROWS, 1 + int(2 * np.abs(bare.position[:, 0]).max() / height * ROWS) // 64)
    mask = OrthographicView(resolution=ROWS)(bare, window).unpack() > 0
    image = Image.new("1", (window.width * FINER, ROWS * FINER))
    draw = ImageDraw.Draw(image)
    columns = (mesh["wood"][0] / height * ROWS + window.width / 2) * FINER - 0.5
    rows = (ROWS - mesh["wood"][2] / height * ROWS) * FINER - 0.5
    for corners in mesh["triangles"].T:
        draw.polygon([(float(columns[i]), float(rows[i])) for i in corners], fill=1)
    drawn = np.asarray(image).reshape(ROWS, FINER, -1, FINER).mean(axis=(1, 3)) > 0.5
    return float((mask & drawn).sum() / (mask | drawn).sum())


def test_what_is_not_installed_is_said_with_the_command_that_installs_it(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ValueError, match=r"no program 'nod'.*npm install --prefix generators/external/eztree$"):
        eztree(node="nod")
    monkeypatch.setattr(adapter, "installed", lambda: False)
    with pytest.raises(ValueError, match=r"@dgreenheck/ez-tree is not installed.*npm install --prefix generators"):
        eztree()
