from __future__ import annotations

import math

import numpy as np
import pytest

from treefit.plant import Plant
from treefit.plant.characteristics import MEASURES, Characteristics, ratio
from treefit.plant.extent import extent_of


def pole(height: float = 4.0, leaf: float = 0.5) -> Plant:
    """A cylinder of 0.1 m radius with one flat leaf lying at its top, pointing to the right."""
    f32 = np.float32
    return Plant(
        np.array([[0, 0, 0], [0, 0, height]], f32), np.full(2, 0.1, f32), np.array([-1, 0], np.int32),
        np.zeros(2, np.int32), np.array([[0, 0, height]], f32), np.array([[1, 0, 0]], f32), np.array([[0, 0, 1]], f32),
        np.array([[leaf, leaf / 2]], f32),
    )  # fmt: skip


def test_measures_of_a_pole_are_its_own() -> None:
    plant = pole()
    voxel = (4.0 / 16) ** 3
    assert MEASURES["vertices"](plant) == 2
    assert MEASURES["height"](plant) == pytest.approx(4)
    assert MEASURES["width"](plant) == pytest.approx(0.5)
    assert MEASURES["leaf_size"](plant) == pytest.approx(0.5)
    assert MEASURES["leaf_density"](plant) == pytest.approx(math.pi / 4 * 0.5 * 0.25 / voxel)
    assert MEASURES["branch_density"](plant) == pytest.approx(math.pi * 0.01 * 4 / voxel, rel=1e-5)


def test_extent_counts_leaves_from_every_side() -> None:
    extent = extent_of(pole(leaf=1.0))
    assert (extent.left, extent.right) == pytest.approx((0, 1))


def test_multipliers_are_smaller_by_larger() -> None:
    wishes = Characteristics(vertices=4, height=2.0)
    assert wishes.multipliers(pole()) == {"vertices": 0.5, "height": pytest.approx(0.5)}
    assert Characteristics(vertices=None).multipliers(pole()) == {}


def test_ratio_of_nothing_to_nothing_is_one() -> None:
    assert ratio(0, 0) == 1
    assert ratio(0, 3) == 0
    assert ratio(3, 2) == ratio(2, 3) == pytest.approx(2 / 3)


def test_only_wishes_in_metres_see_the_size() -> None:
    assert not Characteristics().sees_size
    assert Characteristics(height=5.0).sees_size


def test_a_wish_out_of_range_is_refused() -> None:
    with pytest.raises(ValueError, match="greater than 0"):
        Characteristics(height=-1.0)
