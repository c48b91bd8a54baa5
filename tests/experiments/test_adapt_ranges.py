"""Ranges that task=adapt proposes: examples become flat, names and values become ranges, ranges become narrower."""

from __future__ import annotations

from pathlib import Path

import pytest

from experiments.adapting.example import Example, flattened, read_example
from experiments.adapting.names import says, words
from experiments.adapting.narrow import NARROWED, narrowed
from experiments.adapting.ranges import DETAIL, LOOK, SEED, TEXT, ZERO, Proposal, propose
from experiments.adapting.space import as_space, given
from experiments.errors import UserError
from treefit.plant import Value


def proposed(**values: object) -> dict[str, Proposal]:
    return {one.name: one for one in propose(flattened(values, "test"))}


def range_of(name: str, value: object) -> tuple[str, float, float, str]:
    parameter = proposed(**{name: value})[name].parameter
    assert parameter is not None
    assert parameter.default == value
    return parameter.kind, parameter.low, parameter.high, parameter.scale


def test_nested_tables_and_lists_become_flat_names() -> None:
    found = flattened({"a": {"b": [1, {"c": 2.5}]}, "d": True, "e": "oak", "f": None, "g": {}, "1": 3}, "test")
    assert found.values == {"a.b.0": 1, "a.b.1.c": 2.5, "d": True, "e": "oak", "1": 3}
    assert found.notes == ("f: None is no number, text, true or false",)


def test_a_table_with_a_value_says_more_of_it() -> None:
    found = flattened({"shape": {"value": "cone", "choices": ["cone", "ball"]}, "x": {"value": 1, "y": 2}}, "test")
    assert found.values == {"shape": "cone", "x.value": 1, "x.y": 2}
    assert found.hints == {"shape": {"choices": ["cone", "ball"]}}


@pytest.mark.parametrize(("text", "message"), [
    ('{"a": 1,', r"is no JSON file \(line 1: "), ("[1]", "must be a table of names and values"),
    ("{}", "has no number, text, true or false"), ('{"a": NaN}', "has no number"),
    ('{"a": {"b": 1}, "a.b": 2}', "has two values of the name a.b"), ("[" * 100_000, "is no JSON file"),
])  # fmt: skip
def test_what_is_no_example_is_told_on_one_line(tmp_path: Path, text: str, message: str) -> None:
    file = tmp_path / "example.json"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(UserError, match=message) as caught:
        read_example(file)
    assert "\n" not in str(caught.value)


def test_names_are_read_from_their_last_word_on() -> None:
    assert words("leaves.sizeVariance_2") == ["leaves", "size", "variance"]
    assert says("leaves.sizeVariance_2") == ["share", "size", "count"]
    assert [says(name)[:1] for name in ("nBranches", "branchAngles.1", "RNGSeed", "seedling", "xyz")] == [
        ["count"], ["angle"], ["seed"], [], [],
    ]  # fmt: skip


@pytest.mark.parametrize(("name", "value", "expected"), [
    ("trunk.length", 20, ("float", 10, 40, "log")), ("bare", True, ("bool", 0, 1, "linear")),
    ("levels", 3, ("int", 2, 4, "linear")), ("levels", 1, ("int", 1, 2, "linear")),
    ("branches", 7, ("int", 3, 14, "linear")), ("branches", 40, ("int", 20, 80, "log")),
    ("branches", 1, ("int", 0, 3, "linear")), ("branches", 0, ("int", 0, 2, "linear")),
    ("a", -3, ("int", -6, 6, "linear")), ("a", 12, ("int", 6, 24, "log")),
    ("split_probability", 0.3, ("float", 0, 1, "linear")), ("split_probability", 0, ("float", 0, 1, "linear")),
    ("force.strength", 0.01, ("float", 0.005, 0.02, "log")), ("variance", 12, ("float", 6, 24, "log")),
    ("angle", 50, ("float", 20, 80, "linear")), ("angle", 10, ("float", 0, 40, "linear")),
    ("angle", -20, ("float", -50, 10, "linear")), ("twist", 0.4, ("float", 0.2, 0.8, "log")),
    ("direction.y", 1, ("float", 0.5, 1, "linear")), ("gravity", -0.2, ("float", -0.4, 0.4, "linear")),
    ("roughened", 0.7, ("float", 0.35, 1, "log")), ("trunk.radius", 0.7, ("float", 0.35, 1.4, "log")),
])  # fmt: skip
def test_ranges_follow_from_the_value_and_the_name(name: str, value: Value, expected: tuple[object, ...]) -> None:
    assert range_of(name, value) == pytest.approx(expected)


@pytest.mark.parametrize(("name", "value", "reason"), [
    ("leaf.tint", 16711935, LOOK), ("bark.textured", True, LOOK), ("textureScale.x", 2.0, LOOK),
    ("trunk.segments", 8, DETAIL), ("kind", "oak", TEXT), ("twist", 0, ZERO), ("seed", 3, SEED),
])  # fmt: skip
def test_what_is_not_searched_has_a_reason(name: str, value: Value, reason: str) -> None:
    one = proposed(**{name: value})[name]
    assert (one.parameter, one.searched, one.reason) == (None, False, reason)
    assert one.left_out == (name == "seed")


def test_a_list_is_of_one_kind_and_a_zero_has_the_range_of_its_list() -> None:
    found = proposed(pull=[0.5, 2, 0], rings=[0, 6])
    kinds = [found[name].parameter.kind for name in ("pull.0", "pull.1", "pull.2", "rings.0")]  # type: ignore[union-attr]
    assert kinds == ["float", "float", "float", "int"]
    zero = found["pull.2"].parameter
    assert zero is not None
    assert (zero.low, zero.high, zero.default) == (0, 4, 0)


def test_a_program_may_say_its_own_ranges() -> None:
    found = proposed(
        a={"value": 3, "low": 1, "high": 9}, b={"value": 2.0, "doc": "?"}, c={"value": "x", "choices": ["x", "y"]}
    )
    assert found["a"].parameter is not None
    assert (found["a"].parameter.kind, found["a"].parameter.low, found["a"].parameter.high) == ("int", 1, 9)
    assert not found["b"].searched
    assert found["c"].parameter is not None
    assert found["c"].parameter.choices == ("x", "y")
    with pytest.raises(UserError, match="the preset of the program: parameter 'a': low must be under high"):
        proposed(a={"value": 3, "low": 9, "high": 1})


def test_narrowing_halves_ranges_around_the_example() -> None:
    before = propose(Example({"length": 4.0, "branches": 9, "levels": 2, "pull": -1.0, "bare": True}))
    after = {one.name: one for one in narrowed(before, {})}
    ranges = {name: (one.parameter.low, one.parameter.high) for name, one in after.items() if one.parameter}
    assert ranges["length"] == pytest.approx((4 / 2**0.5, 4 * 2**0.5))  # halved in the gene, which is a logarithm
    assert (ranges["branches"], ranges["pull"], ranges["bare"]) == ((7, 13), (-1.5, 0.5), (0, 1))
    assert (after["levels"].reason, after["levels"].searched) == (NARROWED, False)


def test_narrowing_takes_the_end_at_fault_alone() -> None:
    before = propose(Example({"length": 4.0, "radius": 1.0}))
    length, radius = narrowed(before, {"length": "high"})
    assert length.parameter is not None
    assert (length.parameter.low, length.parameter.high) == pytest.approx((2, 4 * 2**0.5))
    assert radius == before[1]


def test_what_the_user_fixes_is_not_searched() -> None:
    space = as_space(given(propose(Example({"a": 2.0, "b": 3.0, "seed": 1})), {"a": 9.0, "c": "x"}))
    assert space.names == ("b",)
    assert space.fixed == {"a": 9.0, "c": "x"}
