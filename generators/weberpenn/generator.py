"""WeberPennGen: the model of Weber and Penn, "Creation and Rendering of Realistic Trees" (1995), complete."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from operator import itemgetter
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from generators.weberpenn.growth import Scratch, grow
from generators.weberpenn.parameters import FULL, LEVELS
from generators.weberpenn.ranges import TAMED
from generators.weberpenn.rules import LevelRule, TreeRule
from treefit.plant import Budget, Look, ParameterSpace, Plant, Value, Values
from treefit.plant.preset import Preset, read_presets
from treefit.plant.streams import child_key, seed_key, two

SPECIES = Path(__file__).parent / "species"

SMALLEST = 0.5
"""Share of `scale` that a tree is high at least: the black oak's is 10 m, give or take 10."""

_SCRATCH = Scratch()
_TURN = 1.0 / 360.0

_OWN = tuple(
    itemgetter(*(f"{name}_{n}" for name in (
        "curve_res", "curve", "curve_back", "curve_v", "bend_v", "taper", "seg_splits", "split_angle", "split_angle_v"
    )))
    for n in range(LEVELS)
)  # fmt: skip
_CHILDREN = tuple(
    itemgetter(*(f"{name}_{min(n + 1, LEVELS - 1)}" for name in (
        "down_angle", "down_angle_v", "rotate", "rotate_v", "length", "length_v", "radius_mod"
    )))
    for n in range(LEVELS)
)  # fmt: skip
"""Values of the stems of each level and of what grows on them, out of all; leaves have angles of their own level."""


@dataclass(frozen=True)
class WeberPennGen:
    """Stems of up to four levels, each a curve of segments with children along it, at the last level leaves."""

    fixed: Mapping[str, Value] = field(default_factory=dict)
    full: bool = False

    name: ClassVar[str] = "weberpenn"
    version: ClassVar[str] = "1"
    parallel: ClassVar[str] = "threads"
    pure: ClassVar[bool] = True
    size_parameter: ClassVar[str | None] = "scale"
    age_parameter: ClassVar[str | None] = None
    family: ClassVar[Path | None] = Path(__file__).parent / "family"

    @cached_property
    def space(self) -> ParameterSpace:
        """Parameters that the generator takes."""
        return (FULL if self.full else TAMED).fix(**self.fixed)

    @cached_property
    def presets(self) -> Mapping[str, Preset]:
        """Species by name, with all values: what a file leaves out is not what a search has it fixed to."""
        found = read_presets(SPECIES).items()
        return {name: replace(preset, values=FULL.complete(preset.values)) for name, preset in found}

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        """Plant grown from `values` by name, `scale` metres high (leaf_scale is in metres of its own)."""
        key = seed_key(seed)
        tree = _tree_rule(values, *map(float, (*two(child_key(key, 2)), two(child_key(key, 3))[0])))
        told = [*tree, *(number for level in range(int(tree.levels)) for number in _level_rule(values, level, tree))]
        numbers, integers = np.empty((4, budget.vertices), np.float32), np.empty((2, budget.vertices), np.int32)
        leaves = np.empty((11, budget.leaves), np.float32)
        scratch, picks = _SCRATCH.room(budget.vertices)  # a clone has one of its own at least
        n, k, cut = grow(np.array(told, np.float64), key, scratch, picks, numbers, integers, leaves)
        look = Look(int(values["lobes"]), float(values["lobe_depth"]), str(values["leaf_shape"]))
        return Plant.of_rows(numbers[:, :n], integers[:, :n], leaves[:, :k], cut, look)


def _tree_rule(v: Mapping[str, Any], u1: float, u2: float, u3: float) -> TreeRule:
    """Rule of the whole tree; the draws in [0, 1) vary height, length and radius of the trunk."""
    height = max(v["scale"] + v["scale_v"] * (2 * u1 - 1), SMALLEST * v["scale"])
    length = max(v["length_0"] + v["length_v_0"] * (2 * u2 - 1), 0.05) * height
    radius = length * v["ratio"] * max(v["scale_0"] + v["scale_v_0"] * (2 * u3 - 1), 0.05)
    return TreeRule(
        v["levels"], v["shape"], height, v["base_size"], length, radius, v["flare"], v["base_splits"], v["ratio_power"],
        v["attraction_up"], v["prune_ratio"], v["prune_width"], v["prune_width_peak"], v["prune_power_low"],
        v["prune_power_high"], v["leaf_scale"], v["leaf_scale"] * v["leaf_scale_x"], v["leaf_bend"],
    )  # fmt: skip


def _level_rule(v: Mapping[str, Any], n: int, tree: TreeRule) -> LevelRule:
    """Rule of the stems of level `n` and of where their children begin; angles become turns."""
    segments, curve, back, curve_v, bend_v, taper, splits, split_angle, split_angle_v = _OWN[n](v)
    down, down_v, rotate, rotate_v, *lengths = _CHILDREN[n](v)
    leafy, child = n == v["levels"] - 1, min(n + 1, LEVELS - 1)
    part = _TURN / segments
    halves = (curve * part, curve * part) if back == 0 else (2 * curve * part, 2 * back * part)
    bare = tree.bare * tree.height / tree.length if n == 0 else v[f"base_size_{n}"]
    return LevelRule(
        segments, *halves, -curve_v * _TURN if curve_v < 0 else curve_v * part, curve_v < 0, bend_v * part,
        taper, splits, split_angle * _TURN, split_angle_v * _TURN, min(bare, 0.99),
        v["leaves"] if leafy else v[f"branches_{child}"], 1 if leafy else v[f"whorl_{child}"],
        down * _TURN, down_v * _TURN, rotate * _TURN, rotate_v * _TURN, *lengths,
    )  # fmt: skip
