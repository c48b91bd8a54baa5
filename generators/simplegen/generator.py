"""SimpleGen: a simple set of rules for the recursive description of a tree (sec. 6)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from generators.simplegen.growth import STEM_FIELDS, Crown, LevelRule, Wood, grow_level
from generators.simplegen.leaves import LeafRule, Leaves, grow_leaves
from generators.simplegen.parameters import FIXED, LEVELS, NEUTRAL, SPACE
from treefit.plant import Budget, ParameterSpace, Plant, Value, Values

SHORTEST = 0.002  # of the trunk; shorter branches do not grow
CROWN = (
    "crown_bottom", "crown_peak", "crown_top", "crown_power_low", "crown_power_high", "branch_angle_change",
    "asymmetry",
)  # fmt: skip
BARE_JOINTS = 6  # of the bare part of the trunk; that of a branch is one segment with its first joint
TRUNK_WOBBLE = 0.3  # the trunk is that much straighter than its branches


@dataclass(frozen=True)
class SimpleGen:
    """A straight branch per stem, at every joint past its bare part a child, at the last level leaves.

    `fixed` takes parameters out of the search; `additions=False` leaves the paper's 19 only.
    """

    fixed: Mapping[str, Value] = field(default_factory=lambda: dict(FIXED))
    additions: bool = True

    name: ClassVar[str] = "simplegen"
    version: ClassVar[str] = "1"
    parallel: ClassVar[str] = "threads"
    size_parameter: ClassVar[str | None] = "branch_len_0"

    def __post_init__(self) -> None:
        self.space  # noqa: B018 - names and values in `fixed` are checked at the border

    @cached_property
    def space(self) -> ParameterSpace:
        """Parameters that the generator takes."""
        neutral = {} if self.additions else NEUTRAL
        return SPACE.fix(**{**neutral, **self.fixed})

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        """Plant grown from `values` by name; its size is branch_len_0 metres of trunk."""
        counts = [int(values[f"branch_count_{level}"]) for level in range(int(values["levels"]))]
        number = {name: float(value) for name, value in values.items()}
        rules = [_level_rule(number, level, count, len(counts)) for level, count in enumerate(counts)]
        stems = [1]
        for rule in rules[:-1]:
            stems.append(stems[-1] * ((rule.joints - 1) * rule.whorl + 1))
        capacity = min(
            1 + sum(n * (rule.bare_joints + rule.joints) for n, rule in zip(stems, rules, strict=True)), budget.vertices
        )
        wood = Wood(np.empty((3, capacity), np.float32), np.empty(capacity, np.float32), np.empty(capacity, np.int32),
                    np.empty(capacity, np.int32))  # fmt: skip
        first, n, keys, cut = _grow_branches(values, rules, stems, wood, seed)
        leaf_rule = _leaf_rule(values, rules[-1], first)
        room = 0 if cut else min((n - first) * leaf_rule.number, budget.leaves)
        leaves = Leaves(*(np.empty((rows, room), np.float32) for rows in (3, 3, 3, 2)))
        k, leaves_cut = grow_leaves(leaf_rule, keys, wood.xyz, wood.parent, n, leaves)
        position, axis, normal, size = (array[:, :k].T for array in leaves)
        return Plant(wood.xyz[:, :n].T, wood.radius[:n], wood.parent[:n], wood.level[:n], position, axis, normal, size,
                     cut=cut or leaves_cut)  # fmt: skip


def _grow_branches(
    values: Values, rules: list[LevelRule], stems: list[int], wood: Wood, seed: int
) -> tuple[int, int, NDArray[np.uint64], bool]:
    """Grow all levels; return the first vertex of the last one, the count of vertices, its keys, whether cut."""
    trunk, lean, crown = float(values["branch_len_0"]), float(values["lean"]), _crown(values)
    wood.xyz[:, 0] = 0.0
    wood.radius[0], wood.parent[0], wood.level[0] = trunk * float(values["branch_r_0"]), -1, 0
    front, keys = np.zeros((STEM_FIELDS, 1), np.float32), np.array([seed], np.uint64)
    front[3:8, 0] = math.sin(lean), 0.0, math.cos(lean), trunk, wood.radius[0]
    n, n_stems, first = 1, 1, 1
    for rule in rules:
        room = 1 if rule.last else min(stems[rule.level + 1], len(wood.radius))
        next_front, next_keys = np.empty((STEM_FIELDS, room), np.float32), np.empty(room, np.uint64)
        first = n
        n, m, cut = grow_level(rule, crown, front, keys, n_stems, wood, n, next_front, next_keys)
        if cut or rule.last:
            break
        front, keys, n_stems = next_front, next_keys, m
    return first, n, keys, cut


def _level_rule(number: dict[str, float], level: int, count: int, levels: int) -> LevelRule:
    child, trunk = min(level + 1, LEVELS - 1), level == 0
    return LevelRule(
        level=level, last=level == levels - 1, joints=count, bare_joints=BARE_JOINTS if trunk else 0,
        start=number[f"branching_start_{level}"],
        whorl=int(number["whorl"]) if trunk else 1, angle=number[f"branch_angle_{level}"],
        length=number[f"branch_len_{child}"], radius=number[f"branch_r_{child}"], taper=number["taper"],
        upwards=0.0 if trunk else number["droop_1" if level == 1 else "droop_2"],
        rightwards=number["trunk_bend"] if trunk else 0.0, wobble=number["wobble"] * (TRUNK_WOBBLE if trunk else 1.0),
        variation=number["length_variation"], shortening=0.0 if trunk else number["shortening"],
        shortest=SHORTEST * number["branch_len_0"],
    )  # fmt: skip


def _crown(values: Values) -> Crown:
    bottom, peak, top, low, high, change, asymmetry = (float(values[name]) for name in CROWN)
    return Crown(bottom, peak, top, low, high, change, asymmetry)


def _leaf_rule(values: Values, twig: LevelRule, first: int) -> LeafRule:
    length = float(values["leaf_size"]) * float(values["branch_len_0"])
    return LeafRule(first, twig.joints, twig.angle, float(values["leaves_count"]),
                    int(values["leaf_number"]), length, length * float(values["leaf_width"]))  # fmt: skip
