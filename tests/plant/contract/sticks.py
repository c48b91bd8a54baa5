"""Sticks: a small generator that keeps the contract, made so that a test can have it break one rule."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from treefit.plant import Budget, Parameter, ParameterSpace, Plant, Preset, Values

SPACE = ParameterSpace((
    Parameter("height", 2.0, 20.0, default=10.0), Parameter("years", 2, 10, kind="int", default=6),
    Parameter("spread", 0.1, 0.5, default=0.3), Parameter("twigs", 1, 6, kind="int", default=3),
))  # fmt: skip

Change = Callable[[Plant, dict[str, object], int, Budget], Plant]


def unchanged(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
    return plant


@dataclass(frozen=True)
class Sticks:
    """A trunk of a joint a year, `twigs` twigs at each with a leaf at their tips; `change` is what is wrong with it."""

    change: Change = unchanged
    space: ParameterSpace = SPACE
    name: str = "sticks"
    version: str = "1"
    parallel: str = "threads"
    pure: bool = True
    size_parameter: str | None = "height"
    age_parameter: str | None = "years"
    presets: Mapping[str, Preset] = field(default_factory=dict)
    family: Path | None = None

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        assert isinstance(values, dict)
        return self.change(grow(values, seed, budget), values, seed, budget)


def grow(values: Values, seed: int, budget: Budget) -> Plant:
    years, twigs, height = int(values["years"]), int(values["twigs"]), float(values["height"])
    trunk = np.zeros((years + 1, 3))
    trunk[:, 2] = np.arange(years + 1) / 10
    angle = np.array([np.random.default_rng((seed, year)).random(twigs) for year in range(years)]).ravel() * 6.28
    out = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=1)
    joint = np.repeat(np.arange(1, years + 1), twigs)
    tips = trunk[joint] + float(values["spread"]) * out
    position = np.concatenate([trunk, tips]) * height
    parent = np.concatenate([np.arange(years + 1) - 1, joint]).astype(np.int32)
    level = (np.arange(len(position)) > years).astype(np.int32)
    radius = height * np.where(level > 0, 0.002, 0.01)
    upwards, size = np.zeros_like(out), np.full((len(tips), 2), 0.02 * height)
    upwards[:, 2] = 1
    v, k = budget.vertices, budget.leaves
    return Plant(
        position[:v].astype(np.float32), radius[:v].astype(np.float32), parent[:v], level[:v],
        position[years + 1 :][:k].astype(np.float32), out[:k].astype(np.float32), upwards[:k].astype(np.float32),
        size[:k].astype(np.float32), cut=len(position) > v or len(tips) > k,
    )  # fmt: skip
