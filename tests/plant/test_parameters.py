from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from treefit.plant import Parameter, ParameterSpace

LENGTH = Parameter("length", 0.1, 10, 1.0, "m", "log")
COUNT = Parameter("count", 2, 6, 3, kind="int")
KIND = Parameter("kind", kind="choice", choices=("a", "b", "c"), default="b")
FLAG = Parameter("flag", kind="bool", default=False)
SPACE = ParameterSpace((LENGTH, COUNT, KIND, FLAG))


@given(st.lists(st.floats(0, 1), min_size=4, max_size=4))
def test_encoding_decoded_values_gives_the_same_values(genes: list[float]) -> None:
    values = SPACE.decode(np.array(genes))
    again = SPACE.decode(SPACE.encode(values))
    assert _close(values, again)


def _close(one: dict[str, object], two: dict[str, object]) -> bool:
    same = all(one[name] == two[name] for name in ("count", "kind", "flag"))
    return same and one["length"] == pytest.approx(two["length"])


def test_whole_numbers_and_choices_share_the_interval_in_equal_parts() -> None:
    genes = np.linspace(0, 1, 10_001)
    counts = np.bincount([int(COUNT.decode(g)) for g in genes])[2:]
    assert counts.min() > 1990
    shares = [sum(KIND.decode(g) == choice for g in genes) for choice in KIND.choices]
    assert min(shares) > 3300


def test_the_ends_of_the_interval_are_the_ends_of_the_range() -> None:
    assert LENGTH.decode(0.0) == pytest.approx(0.1)
    assert LENGTH.decode(1.0) == pytest.approx(10)
    assert (COUNT.decode(0.0), COUNT.decode(1.0)) == (2, 6)


def test_fixed_parameters_are_no_genes_but_are_decoded() -> None:
    space = SPACE.fix(count=9, flag=True)
    assert space.names == ("length", "kind")
    assert space.decode(np.array([0.5, 0.5])) == {"length": pytest.approx(1.0), "count": 9, "kind": "b", "flag": True}
    assert space.release("count").names == ("length", "count", "kind")


def test_complete_takes_given_then_fixed_then_default() -> None:
    values = SPACE.fix(count=5).complete({"kind": "c"})
    assert values == {"length": 1.0, "count": 5, "kind": "c", "flag": False}


def test_a_misspelt_name_is_told_with_a_proposal() -> None:
    with pytest.raises(ValueError, match="no parameter 'lenght'; did you mean 'length'"):
        SPACE.complete({"lenght": 2.0})


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("length", float("nan"), "finite"),
        ("length", "long", "finite number"),
        ("count", 2.5, "whole number"),
        ("kind", "z", "one of a, b, c"),
        ("flag", 1, "true or false"),
    ],
)
def test_a_value_of_the_wrong_kind_is_refused(name: str, value: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        SPACE.complete({name: value})  # type: ignore[dict-item]


def test_impossible_parameters_are_refused() -> None:
    with pytest.raises(ValueError, match="low must be under high"):
        Parameter("x", 2, 1)
    with pytest.raises(ValueError, match="log scale needs low > 0"):
        Parameter("x", 0, 1, scale="log")
    with pytest.raises(ValueError, match="must differ"):
        ParameterSpace((COUNT, COUNT))


def test_values_beyond_the_limits_are_refused_and_those_beyond_the_range_are_not() -> None:
    stem = Parameter("stem", 1, 2, 1.5, least=0, most=10)
    stem.check(9.5)
    with pytest.raises(ValueError, match="'stem': must be at least 0, got -1"):
        stem.check(-1)
    with pytest.raises(ValueError, match="'stem': must be at most 10, got 11"):
        stem.check(11)
