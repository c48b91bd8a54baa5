"""Each rule of the contract finds what breaks it, and nothing else is found."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.plant.contract.broken import BROKEN, Broken
from tests.plant.contract.sticks import Sticks
from treefit.plant import Budget, Plant
from treefit.plant.contract import RULES, Finding, draw_sample, name_of, try_rule
from treefit.plant.contract.limits import a_plant_takes_no_more_than_a_second
from treefit.plant.contract.sample import TRIES


def findings(generator: Sticks, budget: Budget | None = None, count: int = 40) -> dict[str, Finding]:
    sample = draw_sample(generator, count, seed=1, budget=budget or Budget(3_000, 3_000))
    return {name_of(rule): try_rule(rule, sample) for rule in RULES}


def test_a_good_generator_keeps_all_rules() -> None:
    assert {one.rule: one.message for one in findings(Sticks()).values() if one.verdict != "ok"} == {}


@pytest.mark.parametrize("broken", BROKEN, ids=lambda one: f"{one.rule}: {one.words}")
def test_a_broken_rule_is_found_and_no_other(broken: Broken) -> None:
    found = findings(broken.generator, broken.budget)
    assert {one.rule: one.verdict for one in found.values() if one.verdict in ("failed", "warning")} == {
        broken.rule: broken.verdict
    }
    assert broken.words in found[broken.rule].message
    assert "\n" not in found[broken.rule].message


def test_every_rule_has_a_generator_that_breaks_it() -> None:
    of_time = name_of(a_plant_takes_no_more_than_a_second)
    assert {broken.rule for broken in BROKEN} == {name_of(rule) for rule in RULES} - {of_time}


def test_slow_plants_are_told() -> None:
    sample = draw_sample(Sticks(), 5)
    slow = replace(sample, attempts=[replace(attempt, seconds=2.0) for attempt in sample.attempts])
    found = try_rule(a_plant_takes_no_more_than_a_second, slow)
    assert found.verdict == "warning"
    assert "50,000 take 27.8 h on one core" in found.message


def test_a_finding_names_a_plant_that_shows_it() -> None:
    broken = next(one for one in BROKEN if one.rule == "heights are of one kind")
    found = findings(broken.generator)[broken.rule]
    assert found.values is not None
    heights = [float(broken.generator(dict(values), found.seed, Budget()).position[:, 2].max())
               for values in (found.values, {**found.values, "twigs": 1})]  # fmt: skip
    assert heights[1] == pytest.approx(1e4 * heights[0])


def test_a_generator_that_always_fails_is_not_asked_for_long_and_says_why_once() -> None:
    calls = 0

    def fail(*_: object) -> Plant:
        nonlocal calls
        calls += 1
        raise OSError("no\nbark")

    found = findings(Sticks(fail), count=300)
    assert calls == TRIES + 1
    assert found["random genomes give valid plants"].verdict == "failed"
    assert "10 of 10 give none, the first: OSError: no bark" in found["random genomes give valid plants"].message
    assert {one.verdict for one in found.values()} == {"ok", "failed", "warning", "not tried"}
    assert found["levels rise by one at most"].verdict == "not tried"
    assert [one.rule for one in found.values() if one.verdict == "failed"] == ["random genomes give valid plants"]


@pytest.mark.parametrize(("given", "words"), [
    (lambda plant, *_: None, "TypeError: a Plant must be returned, got NoneType"),
    (lambda plant, *_: replace(plant, radius=plant.radius * np.nan), "ValueError: plant: radius has NaN"),
    (lambda plant, *_: replace(plant, parent=None), "AttributeError"),
])  # fmt: skip
def test_what_is_no_plant_is_told(given: object, words: str) -> None:
    assert words in findings(Sticks(given))["random genomes give valid plants"].message  # type: ignore[arg-type]


def test_a_plant_that_is_there_once_and_not_again_is_another_answer_to_the_same_input() -> None:
    seen: set[str] = set()

    def once(plant: Plant, values: dict[str, object], *_: object) -> Plant:
        key = str(values)
        if key in seen:
            raise RuntimeError("not twice")
        seen.add(key)
        return plant

    found = findings(Sticks(once))["the same input gives the same bytes"]
    assert (found.verdict, "none within 50000 vertices" in found.message) == ("failed", True)
    assert "RuntimeError: not twice" in found.message


def test_a_property_that_raises_is_a_finding() -> None:
    class Moody(Sticks):
        presets = property(lambda self: 1 / 0)  # type: ignore[assignment]

        def __init__(self) -> None:
            pass

    found = findings(Moody())["presets are plants of the generator"]
    assert (found.verdict, found.message) == ("failed", "it raised ZeroDivisionError: division by zero")
