"""SimpleGen: a simple set of rules for the recursive description of a tree (sec. 6)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from generators.simplegen.crown import KNOTS, broken_line
from generators.simplegen.growth import Scratch, grow
from generators.simplegen.parameters import FIXED, LEVELS, NEUTRAL, SPACE
from generators.simplegen.rules import LeafRule, LevelRule
from treefit.plant import Budget, ParameterSpace, Plant, Preset, Value, Values
from treefit.plant.streams import seed_key

SHORTEST = 0.002  # of the trunk; shorter branches do not grow
BARE_JOINTS = 6  # of the bare part of the trunk; that of a branch is one segment with its first joint
TRUNK_WOBBLE = 0.3  # the trunk is that much straighter than its branches

_SCRATCH = Scratch()


@dataclass(frozen=True)
class SimpleGen:
    """A straight branch per stem, at every joint past its bare part a child, at the last level leaves.

    `fixed` takes parameters out of the search; `additions=False` leaves the paper's 19 only.
    """

    fixed: Mapping[str, Value] = field(default_factory=lambda: dict(FIXED))
    additions: bool = True

    name: ClassVar[str] = "simplegen"
    version: ClassVar[str] = "2"
    parallel: ClassVar[str] = "threads"
    pure: ClassVar[bool] = True
    size_parameter: ClassVar[str | None] = "branch_len_0"
    age_parameter: ClassVar[str | None] = None
    family: ClassVar[Path | None] = Path(__file__).parent / "family"
    presets: ClassVar[Mapping[str, Preset]] = {}

    def __post_init__(self) -> None:
        self.space  # noqa: B018 - names and values in `fixed` are checked at the border

    @cached_property
    def space(self) -> ParameterSpace:
        """Parameters that the generator takes."""
        neutral = {} if self.additions else NEUTRAL
        return SPACE.fix(**{**neutral, **self.fixed})

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        """Plant grown from `values` by name; its size is branch_len_0 metres of trunk."""
        rules = [_level_rule(values, level) for level in range(int(values["levels"]))]
        leaf_rule = _leaf_rule(values, rules[-1])
        stems, vertices = 1, 1 + rules[0].bare_joints
        for rule in rules[:-1]:
            vertices += stems * rule.joints
            stems *= (rule.joints - 1) * rule.whorl + 1
        vertices = min(vertices + stems * rules[-1].joints, budget.vertices)
        room = min(stems * rules[-1].joints * leaf_rule.number, budget.leaves)
        numbers, integers = np.empty((4, vertices), np.float32), np.empty((2, vertices), np.int32)
        leaves = np.empty((11, room), np.float32)
        told = np.array([*_numbers_of(rules), *leaf_rule], np.float64)
        trunk = [float(values[name]) for name in ("branch_len_0", "branch_r_0", "lean")]
        scratch = _SCRATCH.room(min(stems, vertices))
        n, k, cut = grow(told, _crown(values), len(rules), *trunk, seed_key(seed), scratch, numbers, integers, leaves)
        return Plant.of_rows(numbers[:, :n], integers[:, :n], leaves[:, :k], cut)


def _numbers_of(rules: list[LevelRule]) -> list[float]:
    """Numbers of the rules of all levels, one after the other."""
    return [number for rule in rules for number in rule]


def _level_rule(values: Mapping[str, Any], level: int) -> LevelRule:
    child, trunk = min(level + 1, LEVELS - 1), level == 0
    return LevelRule(
        joints=int(values[f"branch_count_{level}"]), bare_joints=BARE_JOINTS if trunk else 0,
        start=values[f"branching_start_{level}"],
        whorl=int(values["whorl"]) if trunk else 1, angle=values[f"branch_angle_{level}"],
        length=values[f"branch_len_{child}"], radius=values[f"branch_r_{child}"],
        taper=values["trunk_taper" if trunk else "taper"],
        upwards=0.0 if trunk else values["droop_1" if level == 1 else "droop_2"],
        child_upwards=values["droop_1" if trunk else "droop_2"],
        rightwards=values["trunk_bend"] if trunk else 0.0, wobble=values["wobble"] * (TRUNK_WOBBLE if trunk else 1.0),
        variation=values["length_variation"], shortening=0.0 if trunk else values["shortening"],
        shortest=SHORTEST * values["branch_len_0"],
    )  # fmt: skip


def _crown(values: Mapping[str, Any]) -> NDArray[np.float32]:
    trunk = values["branch_len_0"]
    width = trunk * values["branch_len_1"]
    bottom = trunk * values["branching_start_0"] * (1.0 - values["crown_hang"])
    left, right = (
        width * np.array([values[f"crown_{side}_{knot}"] for knot in range(KNOTS)]) for side in ("left", "right")
    )
    shape = [values[name] for name in ("crown_keep", "branch_angle_change", "crown_depth")]
    lines = [*broken_line((left + right) / 2), *broken_line((right - left) / 2)]
    return np.array([bottom, trunk * (1.0 + values["crown_rise"]) - bottom, *shape, *lines], np.float32)


def _leaf_rule(values: Mapping[str, Any], twig: LevelRule) -> LeafRule:
    length = values["leaf_size"] * values["branch_len_0"]
    return LeafRule(
        twig.angle, values["leaves_count"], int(values["leaf_number"]), length, length * values["leaf_width"]
    )
