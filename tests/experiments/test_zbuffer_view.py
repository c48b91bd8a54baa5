from __future__ import annotations

import numpy as np
import pytest

from experiments.zbuffer_view import ellipse, zbuffer_mask
from tests.view.zbuffer import textbook_mask
from treefit.mask import BRANCH, FOLIAGE
from treefit.plant import Plant
from treefit.view import Frame


@pytest.mark.slow
def test_it_is_the_textbook_pixel_by_pixel(plants: list[Plant]) -> None:
    for plant in plants[:2]:
        part = young(plant, 150, 60)
        one, two = zbuffer_mask(part, Frame(64, 2)), textbook_mask(part, Frame(64, 2))
        assert set(np.unique(two)) == {0, BRANCH, FOLIAGE}
        assert (one != two).sum() <= 1  # a centre that lies on an edge or at equal depth


def young(plant: Plant, vertices: int, leaves: int) -> Plant:
    """The first vertices and leaves of a plant."""
    wood = (getattr(plant, name)[:vertices] for name in ("position", "radius", "parent", "level"))
    leaf = (getattr(plant, f"leaf_{name}")[:leaves] for name in ("position", "axis", "normal", "size"))
    return Plant(*wood, *leaf)


def test_outlines_have_the_area_of_the_ellipse_they_stand_for() -> None:
    for corners in (6, 8, 24):
        x, y = ellipse(corners).T
        area = 0.5 * abs((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
        assert area == pytest.approx(np.pi)


def post_and_leaf(leaf_at: tuple[float, float, float], leaf_axis: tuple[float, float, float]) -> Plant:
    """A post of 2 m and 0.2 m width, and a leaf 1.4 m long and 0.1 m wide that grows away from the viewer."""
    axis = np.array(leaf_axis)
    leaf = [np.array([row], np.float32) for row in (leaf_at, axis, np.cross([1, 0, 0], axis))]
    return Plant(
        np.array([[0, 0, 0], [0, 0, 2]], np.float32), np.array([0.1, 0.1], np.float32), np.array([-1, 0], np.int32),
        np.zeros(2, np.int32), *leaf, np.array([[2**0.5, 0.1]], np.float32),
    )  # fmt: skip


def test_a_pixel_has_a_depth_of_its_own() -> None:
    plant = post_and_leaf((0, -0.6, 0.5), (0, 0.5**0.5, 0.5**0.5))  # passes the post's front, y = -0.1, at z = 1
    column = zbuffer_mask(plant, Frame(200, 1))[:, 32]
    assert (column[102:148] == FOLIAGE).all()
    assert (column[1:98] == BRANCH).all()


def test_a_stem_is_round() -> None:
    plant = post_and_leaf((0.08, -0.09, 0.3), (0, 0, 1))  # its front is at y = -0.06 there, at y = -0.1 in the middle
    row = zbuffer_mask(plant, Frame(200, 1))[100]
    assert (row[22:32] == BRANCH).all()
    assert (row[38:42] == FOLIAGE).all()
