from __future__ import annotations

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest

from treefit.plant import Budget, Plant, check_plant
from treefit.plant.characteristics import MEASURES, Characteristics, OfHeight
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


def test_a_plant_that_declares_its_complexity_has_that_many_vertices() -> None:
    assert MEASURES["vertices"](replace(pole(), complexity=812.5)) == 812.5
    with pytest.raises(ValueError, match="complexity must be a number over 0, got nan"):
        check_plant(replace(pole(), complexity=math.nan))


def test_extent_counts_leaves_from_every_side() -> None:
    extent = extent_of(pole(leaf=1.0))
    assert (extent.left, extent.right) == pytest.approx((0, 1))


def test_multipliers_are_smaller_by_larger() -> None:
    wishes = Characteristics(vertices=4, height=2.0)
    assert wishes.multipliers(pole()) == {"vertices": 0.5, "height": pytest.approx(0.5)}
    assert Characteristics(vertices=None).multipliers(pole()) == {}


def test_inside_a_range_the_multiplier_is_one_outside_that_of_the_nearest_bound() -> None:
    for wish, share in (([2, 9], 1), ([4, 9], 0.5), ({"max": 5}, 1), ({"min": 8}, 0.25), ({"max": 2}, 1)):
        assert Characteristics(vertices=wish).multipliers(pole()) == {"vertices": share}  # type: ignore[arg-type]
    wishes = Characteristics(None, height=(1.0, 2.0), width={"max": 0.25}, leaf_size=(0.25, 1.0))
    assert wishes.multipliers(pole()) == pytest.approx({"height": 0.5, "width": 0.5, "leaf_size": 1})


@pytest.mark.parametrize(
    ("height", "width"),
    [(4.0, 0.4 / 0.5), (2.0, 0.2 / 0.5), ((3.0, 9.0), 0.4 / 0.5), ((1.0, 3.0), 0.3 / 0.5), ((5.0, 6.0), 0.5 / 0.5)],
)
def test_a_width_from_the_picture_is_that_of_the_nearest_wanted_height(height: object, width: float) -> None:
    wishes = Characteristics(None, height=height, width="from_image").for_picture(0.1)  # type: ignore[arg-type]
    assert wishes.width == OfHeight(0.1)
    assert wishes.multipliers(pole())["width"] == pytest.approx(width)
    assert wishes.for_picture(0.7) == wishes
    assert pickle.loads(pickle.dumps(wishes)).multipliers(pole()) == wishes.multipliers(pole())


def test_a_width_from_the_picture_needs_a_height() -> None:
    with pytest.raises(ValueError, match="from_image needs a height"):
        Characteristics(width="from_image")
    with pytest.raises(ValueError, match="must be a number"):
        Characteristics(height=3.0, width="from_picture")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("wishes", "budget"),
    [
        (Characteristics(), Budget(12000, 24000)),
        (Characteristics(vertices=None), Budget()),
        (Characteristics(vertices={"max": 5000}), Budget(20000, 40000)),
        (Characteristics(vertices=(10, 20)), Budget(100, 200)),
        (Characteristics(vertices={"min": 500}), Budget()),
        (Characteristics(vertices=None, triangles={"max": 7000}), Budget(4000, 14000)),
        (Characteristics(vertices={"max": 500}, triangles={"max": 7000}), Budget(2000, 4000)),
    ],
)
def test_a_plant_may_grow_to_four_times_the_most_that_is_wanted(wishes: Characteristics, budget: Budget) -> None:
    assert wishes.budget == budget


def test_only_wishes_in_metres_see_the_size() -> None:
    assert not Characteristics(triangles={"max": 900}).sees_size
    assert Characteristics(height=5.0).sees_size


def test_a_wish_out_of_range_is_refused() -> None:
    with pytest.raises(ValueError, match="greater than 0"):
        Characteristics(height=-1.0)
    with pytest.raises(ValueError, match="whole number"):
        Characteristics(vertices=2.5)
