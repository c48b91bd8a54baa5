from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from treefit.plant.bounds import Bounds, bounds_of, share_within

POSITIVE = st.floats(1e-3, 1e6)


@pytest.mark.parametrize(
    ("wish", "low", "high", "words"),
    [
        (3000, 3000, 3000, "3000"),
        (1.25, 1.25, 1.25, "1.25"),
        ([2000, 4000], 2000, 4000, "2000 to 4000"),
        ({"max": 5000}, 0, 5000, "at most 5000"),
        ({"min": 100}, 100, math.inf, "at least 100"),
        ({"min": None, "max": 1234567}, 0, 1234567, "at most 1234567"),
        ({"min": 3, "max": 4}, 3, 4, "3 to 4"),
    ],
)
def test_a_wish_is_a_number_a_range_or_limits(wish: object, low: float, high: float, words: str) -> None:
    assert bounds_of(wish) == Bounds(low, high)
    assert str(bounds_of(wish)) == words


@pytest.mark.parametrize(
    ("wish", "message"),
    [
        ("many", "must be a number, a range"),
        (True, "must be a number, a range"),
        (math.nan, "must be a number, a range"),
        ([1], "must be a number, a range"),
        ([1, 2, 3], "must be a number, a range"),
        ([1, "x"], "must be a number, a range"),
        ({}, "must be a number, a range"),
        ({"max": None}, "must be a number, a range"),
        ({"most": 3}, r"must be a number, a range \[low, high\] or {min: low, max: high}, got {'most': 3}"),
        (-1, "must be greater than 0, got -1"),
        ([4, 3], "min must not be above max, got 4 and 3"),
        (1, "must be greater than or equal to 2, got 1"),
        (2.5, "must be a whole number, got 2.5"),
    ],
)
def test_anything_else_is_refused_in_one_line(wish: object, message: str) -> None:
    with pytest.raises(ValueError, match=f"^{message}") as caught:
        bounds_of(wish, whole=True, least=0 if wish == -1 else 2 if wish == 1 else 0)
    assert "\n" not in str(caught.value)


@given(POSITIVE, POSITIVE, POSITIVE)
def test_the_share_is_one_inside_and_falls_with_the_distance_outside(value: float, one: float, other: float) -> None:
    low, high = min(one, other), max(one, other)
    share = share_within(value, low, high)
    assert 0 < share <= 1
    assert (share == 1) == (low <= value <= high)
    assert share == pytest.approx(min(1, value / low) * min(1, high / value))


def test_the_share_of_nothing_is_nothing_unless_it_is_wanted() -> None:
    assert share_within(0, 3, 4) == 0
    assert share_within(0, 0, 4) == 1
    assert share_within(1e9, 5, math.inf) == 1
    assert math.isnan(share_within(math.nan, 3, 4))


@pytest.mark.parametrize(
    ("wish", "middle"), [(3000, 3000), ([1000, 4000], 2000), ({"max": 5000}, 5000), ({"min": 8}, 8)]
)
def test_one_number_stands_for_all(wish: object, middle: float) -> None:
    assert bounds_of(wish).middle == middle
