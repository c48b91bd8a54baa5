"""A generator as somebody else may have written it: what a call does may depend on how many there were before."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import ClassVar

import numpy as np

from generators.simplegen import SimpleGen
from treefit.plant import Budget, ParameterSpace, Plant, Preset, Values

Mood = Callable[[int, Values, int], int]
"""Function on the number of the call, the values and the seed to the seed that counts; it may raise."""


@dataclass
class Foreign:
    """SimpleGen in a `mood`; `calls` are the genomes that were asked for, in order."""

    mood: Mood = lambda number, values, seed: seed
    pure: bool = False
    parallel: str = "threads"
    calls: list[bytes] = field(default_factory=list)
    name: str = "foreign"
    version: str = "1"
    size_parameter: str | None = "branch_len_0"
    age_parameter: str | None = None
    family: Path | None = None
    presets: ClassVar[Mapping[str, Preset]] = {}

    def __post_init__(self) -> None:
        self._numbers = count()

    @property
    def space(self) -> ParameterSpace:
        return SimpleGen().space

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        number = next(self._numbers)
        self.calls.append(np.array([float(value) for value in values.values()]).tobytes())
        return SimpleGen()(values, self.mood(number, values, seed), budget)


class TimedOut(RuntimeError):  # noqa: N818  as a foreign fault may be called
    """It gave no answer in time."""


def dead(*_: object) -> int:
    """A mood in which nothing is ever answered."""
    raise TimedOut("no answer within 5 s")


def dead_from(first: int, last: float = np.inf) -> Mood:
    """A mood in which nothing is answered from one call to another."""

    def mood(number: int, values: Values, seed: int) -> int:
        return dead() if first <= number < last else seed

    return mood


def now_and_then(every: int) -> Mood:
    """A mood in which every so manieth call is not answered."""

    def mood(number: int, values: Values, seed: int) -> int:
        return dead() if number % every == every - 1 else seed

    return mood


def unsure(most: float) -> Mood:
    """A mood in which trees of a wobble up to `most` are other ones each time."""

    def mood(number: int, values: Values, seed: int) -> int:
        return seed + 1 + number if float(values["wobble"]) <= most else seed

    return mood
