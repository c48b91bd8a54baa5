"""GEGen: growth year by year in an environment, after [Yi15], [Yi18] and Palubicki et al. 2009 (sec. 6)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from generators.gegen.environment import Environment, environment_of
from generators.gegen.growth import grow
from generators.gegen.parameters import FIXED, OWN_SHAPE, SPACE
from generators.gegen.rules import rule_of
from generators.gegen.scratch import Scratch
from treefit.plant import Budget, Look, ParameterSpace, Plant, Preset, Value, Values, read_presets
from treefit.plant.streams import seed_key

HABITS = Path(__file__).parent / "habits"

SPARE = 500
"""Joints that a tree may have over 1.3 times its `internodes`: those of its leader, and what rounding adds."""

_SCRATCH = Scratch()
_SPACES = ("sampled", "markers")


@dataclass(frozen=True)
class GEGen:
    """A tree that grows year by year under light."""

    fixed: Mapping[str, Value] = field(default_factory=lambda: dict(FIXED))
    environment: Environment | Mapping[str, Any] | None = None
    space_by: str = "sampled"  # sampled | markers: how a bud finds the best-lit point

    name: ClassVar[str] = "gegen"
    version: ClassVar[str] = "1"
    parallel: ClassVar[str] = "threads"
    pure: ClassVar[bool] = True
    size_parameter: ClassVar[str | None] = "internode"
    age_parameter: ClassVar[str | None] = "age"
    family: ClassVar[Path | None] = Path(__file__).parent / "family"

    def __post_init__(self) -> None:
        if self.space_by not in _SPACES:
            raise ValueError(f"space: must be sampled or markers, got {self.space_by!r}")
        _ = self.around  # what is wrong is told now

    @cached_property
    def around(self) -> Environment:
        """The environment, checked."""
        return environment_of(self.environment)

    @cached_property
    def space(self) -> ParameterSpace:
        """Parameters that the generator takes."""
        return SPACE.fix(**self.fixed)

    @cached_property
    def presets(self) -> Mapping[str, Preset]:
        """Typical habits by name, with all values: what a file leaves out is not what a search has it fixed to."""
        found = read_presets(HABITS).items()
        return {name: replace(preset, values=SPACE.complete(preset.values)) for name, preset in found}

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        """Plant grown from `values` by name."""
        rule = rule_of(values, self.around.slope, self.space_by == "markers")
        capacity = int(1.3 * rule.internodes) + SPARE
        numbers, integers = np.empty((4, budget.vertices), np.float32), np.empty((2, budget.vertices), np.int32)
        leaves = np.empty((11, budget.leaves), np.float32)
        told = np.array(rule, np.float64), seed_key(seed), capacity
        n, k, cut = grow(*told, *_SCRATCH.room(capacity), self.around.scene, numbers, integers, leaves)
        numbers, leaves, size = numbers[:, :n], leaves[:, :k], np.float32(values["internode"])
        numbers *= size
        leaves[:3] *= size
        leaves[9:] *= size
        shape = str(values.get("leaf_shape", OWN_SHAPE))
        look = None if shape == OWN_SHAPE else Look(leaf_shape=shape)
        return Plant.of_rows(numbers, integers[:, :n], leaves, cut, look)


def gegen(
    fixed: Mapping[str, Value] | None = None, environment: Environment | None = None, space: str = "sampled"
) -> GEGen:
    """GEGen with settings by the names of the configuration: `space` of the class is its parameters."""
    return GEGen(FIXED if fixed is None else fixed, environment, space)
