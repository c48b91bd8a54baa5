"""What the viewer page is told of the parameters of candidates."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from experiments.viewer_page import parameter_rows
from treefit.plant import Parameter, ParameterSpace, Value

SPACE = ParameterSpace(
    (
        Parameter("height", 2.0, 10.0, 4.0, "m", doc="how high"),
        Parameter("thin", 0.01, 1.0, 0.1, "1", scale="log"),
        Parameter("forks", 0, 4, 2, "1", kind="int"),
        Parameter("kind", default="fir", kind="choice", choices=("fir", "oak")),
        Parameter("age", 1.0, 9.0, 3.0, "a"),
    ),
    fixed={"age": 3.0},
)


@dataclass(frozen=True)
class Found:
    values: dict[str, Value]


@pytest.fixture
def rows():
    found = [Found(SPACE.complete({})), Found(SPACE.complete({"height": 10.0, "thin": 1.0, "kind": "oak"}))]
    return {row.name: row for row in parameter_rows(found, SPACE)}


def test_every_parameter_has_the_value_of_each_candidate(rows):
    assert [*rows] == [parameter.name for parameter in SPACE.parameters]
    assert rows["height"].values == [4.0, 10.0]
    assert rows["kind"].values == ["fir", "oak"]


def test_places_are_those_in_the_range_of_the_search(rows):
    assert rows["height"].places == [pytest.approx(0.25), pytest.approx(1)]
    assert rows["thin"].places == [pytest.approx(0.5), pytest.approx(1)]
    assert rows["forks"].places == [0.5, 0.5]
    assert rows["kind"].places == [None, None]
    assert rows["age"].places == [None, None]


def test_the_meaning_says_unit_and_range(rows):
    assert rows["height"].unit == "m"
    assert rows["height"].meaning == "how high\nsearched: 2 to 10 m"
    assert rows["forks"].unit == ""
    assert rows["kind"].meaning == "searched: fir, oak"
    assert rows["age"].meaning == "not searched"
