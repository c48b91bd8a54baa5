"""A generator that fails on purpose, in a share of its calls that depends on the values alone."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

import numpy as np

from generators.simplegen import SimpleGen
from treefit.plant import Budget, ParameterSpace, Plant, Preset, Values


@dataclass(frozen=True)
class Failing:
    """SimpleGen that fails when its wobble is in the lowest `share` of the range."""

    share: float = 0.1
    how: str = "raise"  # raise | nan | cycle | empty | exit
    parallel: str = "threads"
    pure: bool = True
    name: str = "failing"
    version: str = "1"
    size_parameter: str | None = "branch_len_0"
    age_parameter: str | None = None
    family: Path | None = None
    presets: ClassVar[Mapping[str, Preset]] = {}

    @property
    def space(self) -> ParameterSpace:
        return SimpleGen().space

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        plant = SimpleGen()(values, seed, budget)
        if float(values["wobble"]) > 0.6 * self.share:
            return plant
        if self.how == "raise":
            raise RuntimeError("the bark\nis loose")
        if self.how == "exit":
            os._exit(3)
        if self.how == "nan":
            return replace(plant, radius=np.full_like(plant.radius, np.nan))
        if self.how == "cycle":
            return replace(plant, parent=np.roll(plant.parent, 1))
        return replace(plant, radius=plant.radius[:0])
