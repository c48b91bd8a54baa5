from __future__ import annotations

import numpy as np
import pytest
import trimesh

from generators.external.mesh import Mesh, plant_of_scene
from tests.generators.external.mesh.shapes import card, joined, pole, scene
from treefit.plant import Plant

pytestmark = pytest.mark.slow  # kernels of meshes take half a minute to compile

AREA = np.pi / 4  # of a leaf by its length and width


def read(foliage: trimesh.Trimesh) -> Plant:
    return plant_of_scene(scene(bark=pole(), leaves=foliage), Mesh(), "z")


@pytest.mark.parametrize("turn", [1, -1])
def test_a_card_is_a_leaf_that_points_away_from_the_wood(turn: int) -> None:
    plant = read(card([0.1 * turn, 0, 1.4], [0.5 * turn, 0, 0], [0, 0.2, 0]))
    np.testing.assert_allclose(plant.leaf_position, [[0.1 * turn, 0, 1.4]], atol=1e-6)
    np.testing.assert_allclose(plant.leaf_axis, [[turn, 0, 0]], atol=1e-6)
    np.testing.assert_allclose(np.abs(plant.leaf_normal), [[0, 0, 1]], atol=1e-6)
    np.testing.assert_allclose(plant.leaf_size, [[0.5, 0.2]], rtol=1e-5)


def test_a_square_card_hangs_by_the_edge_that_is_near() -> None:
    plant = read(card([0.1, 0, 1.4], [0.3, 0, 0], [0, 0.3, 0]))
    np.testing.assert_allclose(plant.leaf_axis, [[1, 0, 0]], atol=1e-6)
    np.testing.assert_allclose(plant.leaf_position, [[0.1, 0, 1.4]], atol=1e-6)


def test_the_back_of_a_card_does_not_count() -> None:
    front = card([0.1, 0, 1.4], [0.5, 0, 0], [0, 0.2, 0])
    back = front.copy()
    back.invert()
    assert read(joined([front, back])).n_leaves == 1
    assert read(trimesh.Trimesh(front.vertices, np.concatenate([front.faces, back.faces]), process=False)).n_leaves == 1


def test_crossed_cards_are_two_leaves() -> None:
    cards = [card([0.1, 0, 1.4], [0.5, 0, 0], across) for across in ([0, 0.2, 0], [0, 0, 0.2])]
    assert read(joined(cards)).n_leaves == 2


def test_a_folded_leaf_is_one_and_no_larger_than_its_triangles() -> None:
    corners = [[0.1, 0, 1.4], [0.3, 0.1, 1.43], [0.6, 0, 1.4], [0.3, -0.1, 1.43]]
    leaf = trimesh.Trimesh(corners, [[0, 2, 1], [0, 3, 2]], process=False)
    plant = read(leaf)
    assert plant.n_leaves == 1
    assert AREA * plant.leaf_size.prod() == pytest.approx(leaf.area, rel=1e-3)
    assert plant.leaf_size[0, 0] == pytest.approx(0.5, rel=1e-3)


def test_a_welded_crown_has_a_leaf_for_each_triangle_and_its_area() -> None:
    crown = trimesh.creation.icosphere(subdivisions=2, radius=0.8)
    crown.apply_translation([0, 0, 2])
    plant = read(crown)
    assert plant.n_leaves == len(crown.faces)
    assert AREA * plant.leaf_size.prod(axis=1).sum() == pytest.approx(crown.area, rel=1e-3)


def test_many_cards_keep_their_sizes_and_axes_at_right_angles() -> None:
    rng = np.random.default_rng(3)
    cards, sizes = [], rng.uniform([0.1, 0.02], [0.3, 0.08], (300, 2))
    for length, width in sizes:
        turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        cards.append(card(rng.uniform([-1, -1, 1], [1, 1, 2]), length * turn[0], width * turn[1]))
    plant = read(joined(cards))
    np.testing.assert_allclose(plant.leaf_size, sizes, rtol=1e-3)
    assert np.abs((plant.leaf_axis * plant.leaf_normal).sum(axis=1)).max() < 1e-5
    for rows in (plant.leaf_axis, plant.leaf_normal):
        np.testing.assert_allclose(np.linalg.norm(rows, axis=1), 1, atol=1e-5)
