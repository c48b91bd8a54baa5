from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from treefit.plant import LEAF_SHAPES, Look, Plant, check_plant


def changed(plant: Plant, name: str, at: object, value: float) -> Plant:
    array = getattr(plant, name).copy()
    array[at] = value
    return replace(plant, **{name: array})


@pytest.mark.parametrize("name", ["position", "radius", "leaf_position", "leaf_axis", "leaf_normal", "leaf_size"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_numbers_that_are_not_finite_are_told_by_name(plants: list[Plant], name: str, value: float) -> None:
    with pytest.raises(ValueError, match=f"plant: {name} has NaN or infinite values"):
        check_plant(changed(plants[0], name, -1, value))


def test_huge_numbers_are_finite(plants: list[Plant]) -> None:
    check_plant(changed(plants[0], "leaf_position", 0, 3e38))


@pytest.mark.parametrize(("at", "value"), [(0, 0), (3, -1)])
def test_only_the_first_vertex_has_no_parent(plants: list[Plant], at: int, value: int) -> None:
    with pytest.raises(ValueError, match="parent must be -1 for vertex 0 and for no other"):
        check_plant(changed(plants[0], "parent", at, value))


def test_parents_come_first(plants: list[Plant]) -> None:
    with pytest.raises(ValueError, match="must be below i"):
        check_plant(changed(plants[0], "parent", 5, 5))


def test_radius_is_not_negative(plants: list[Plant]) -> None:
    with pytest.raises(ValueError, match="radius must not be negative"):
        check_plant(changed(plants[0], "radius", 4, -0.1))


def test_shapes_are_told(plants: list[Plant]) -> None:
    with pytest.raises(ValueError, match=r"leaf_axis must have shape \(\d+, 3\)"):
        check_plant(replace(plants[0], leaf_axis=plants[0].leaf_axis[:-1]))


def test_rows_are_the_same_numbers_whatever_the_layout(plants: list[Plant]) -> None:
    plant = plants[0]
    other = replace(plant, position=np.ascontiguousarray(plant.position), leaf_size=plant.leaf_size.astype(np.float64))
    for one, two in zip(plant.rows, other.rows, strict=True):
        for a, b in zip(one, two, strict=True):
            assert a.tobytes() == b.tobytes()
            assert b.flags.c_contiguous


@pytest.mark.parametrize(
    ("look", "message"),
    [
        (Look(lobes=-1), "lobes must be 0 or more, got -1"),
        (Look(lobes=3, lobe_depth=1.0), r"lobe_depth must be in \[0, 1\), got 1.0"),
        (Look(lobe_depth=-0.1), "lobe_depth must be in"),
        (Look(lobe_depth=np.nan), "lobe_depth must be in"),
        (Look(leaf_shape="elm"), "leaf_shape must be one of broad, round, .*, got 'elm'"),
    ],
)
def test_what_no_mask_sees_is_checked_too(plants: list[Plant], look: Look, message: str) -> None:
    with pytest.raises(ValueError, match=f"plant: {message}"):
        check_plant(replace(plants[0], look=look))


@pytest.mark.parametrize("look", [None, Look(), Look(5, 0.07, "tuft"), *(Look(leaf_shape=one) for one in LEAF_SHAPES)])
def test_every_look_in_range_passes(plants: list[Plant], look: Look | None) -> None:
    check_plant(replace(plants[0], look=look))
