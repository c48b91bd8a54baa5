from __future__ import annotations

import numpy as np
import pytest
import trimesh
from skimage.measure import marching_cubes

from generators.external.mesh import Mesh, plant_of_scene
from tests.generators.external.mesh.shapes import INNER, bend, joined, pole, scene, tube
from treefit.plant import Plant

pytestmark = pytest.mark.slow  # kernels of meshes take half a minute to compile

LIFT = np.array([0.0, 0.0, 0.15])  # so that the foot of a skin is at the ground


def read(wood: trimesh.Trimesh, up: str = "z") -> Plant:
    return plant_of_scene(scene(bark=wood), Mesh(), up)


@pytest.mark.parametrize("end", ["open", "cap", "seam", "soup"])
def test_the_rings_of_a_tube_are_its_vertices(end: str) -> None:
    plant = read(tube(bend(), 0.1, end))
    np.testing.assert_allclose(plant.position, bend() - bend()[0], atol=2e-3)
    assert plant.parent.tolist() == list(range(-1, 11))
    np.testing.assert_allclose(plant.radius, 0.1 * INNER, rtol=0.06)
    assert (plant.level == 0).all()


def test_a_tube_with_tips_has_its_rings_between_them() -> None:
    plant = read(tube(bend() + LIFT, 0.1, "tip"))
    assert plant.n_vertices == 1 + 12 + 1
    np.testing.assert_allclose(plant.position[1:13] - plant.position[1], bend() - bend()[0], atol=2e-3)
    assert np.linalg.norm(plant.position[1]) == pytest.approx(0.1, abs=2e-3)


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("end", ["open", "cap"])
def test_a_branch_begins_on_the_axis_of_the_trunk(turned: bool, end: str) -> None:
    axis = np.linspace([0.05, 0, 1.5], [1.2, 0, 2.2], 6)
    radii = np.linspace(0.05, 0.01, 6)
    branch = tube(axis[::-1], radii[::-1], end) if turned else tube(axis, radii, end)
    plant = read(joined([branch, pole()]))
    first = np.flatnonzero(plant.level == 1)[0]
    assert plant.parent[first] == 2
    assert plant.level.tolist() == [0] * 4 + [1] * (plant.n_vertices - 4)
    np.testing.assert_allclose(plant.position[first], [0, 0, 1.5], atol=0.06)
    np.testing.assert_allclose(plant.position[-1], axis[-1], atol=1e-3)


def test_a_stem_that_goes_on_at_the_tip_is_the_same_stem() -> None:
    above = tube(np.linspace([0, 0, 2], [0.3, 0, 4], 5), 0.09)
    plant = read(joined([pole(), above]))
    assert plant.position[:, 2].max() == pytest.approx(4, abs=0.03)
    assert (plant.level == 0).all()


def test_wood_far_from_all_other_is_joined_too() -> None:
    plant = read(joined([pole(20.0), tube(np.linspace([9, 0, 3], [9, 0, 5], 4), 0.05)]))
    assert plant.n_vertices == 4 + 4 + 1
    assert plant.position[:, 0].max() == pytest.approx(9, abs=0.01)


def test_a_skin_over_a_fork_is_cut_into_its_stems() -> None:
    fork = np.array([0.0, 0.0, 1.5])
    ends = [np.zeros(3), np.array([1.0, 0.0, 3.0]), np.array([-0.9, 0.1, 2.8])]
    plant = read(_around([(end, fork) for end in ends], 0.15))
    tips = np.setdiff1d(np.arange(plant.n_vertices), plant.parent)
    assert len(tips) == 2
    assert plant.level.max() == 1
    for end in ends[1:]:
        assert np.linalg.norm(plant.position[tips] - LIFT - end, axis=1).min() < 0.3
    for p in plant.position - LIFT:  # near to one of the three axes
        assert min(_distance(p, end, fork) for end in ends) < 0.16
    assert np.median(plant.radius) == pytest.approx(0.15, rel=0.15)


def test_wood_under_the_ground_is_cut_off() -> None:
    sunk = tube(np.linspace([1, 2, -0.3], [1, 2, 3.3], 7), np.linspace(0.2, 0.08, 7))
    plant = read(sunk)
    assert plant.position[:, 2].max() == pytest.approx(3.3)
    np.testing.assert_allclose(plant.position[:, 2], [0, 0.3, 0.9, 1.5, 2.1, 2.7, 3.3], atol=1e-5)
    assert plant.radius[0] == pytest.approx(0.19 * INNER, rel=0.01)


def test_y_up_is_turned_and_the_front_stays_in_front() -> None:
    turned = pole().copy()
    turned.vertices = turned.vertices[:, [0, 2, 1]] * (1, 1, -1)
    a, b = read(pole()), read(turned, "y")
    np.testing.assert_allclose(a.position, b.position, atol=1e-6)


def _around(segments: list[tuple[np.ndarray, np.ndarray]], radius: float) -> trimesh.Trimesh:
    """Skin around segments."""
    step = 0.06
    low = np.array([-1.3, -0.4, -0.4])
    grid = np.stack(np.meshgrid(*[low[i] + step * np.arange(n) for i, n in enumerate((44, 16, 64))], indexing="ij"), -1)
    far = np.min([_distance(grid, a, b) for a, b in segments], axis=0)
    corners, faces, _, _ = marching_cubes(far, radius, spacing=(step,) * 3)
    return trimesh.Trimesh(corners + low + LIFT, faces, process=False)


def _distance(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    share = np.clip(((points - a) @ (b - a)) / ((b - a) @ (b - a)), 0, 1)
    return np.asarray(np.linalg.norm(points - a - share[..., None] * (b - a), axis=-1))
