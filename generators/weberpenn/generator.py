"""WeberPennGen: the model of Weber and Penn, "Creation and Rendering of Realistic Trees" (1995), complete."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
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


@dataclass(frozen=True)
class WeberPennGen:
    """Stems of up to four levels, each a curve of segments with children along it, at the last level leaves."""

    fixed: Mapping[str, Value] = field(default_factory=dict)
    full: bool = False

    name: ClassVar[str] = "weberpenn"
    version: ClassVar[str] = "1"
    parallel: ClassVar[str] = "threads"
    size_parameter: ClassVar[str | None] = "scale"

    @cached_property
    def space(self) -> ParameterSpace:
        """Parameters that the generator takes."""
        return (FULL if self.full else TAMED).fix(**self.fixed)

    @cached_property
    def presets(self) -> Mapping[str, Preset]:
        """Species by name."""
        return read_presets(SPECIES)

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        """Plant grown from `values` by name, `scale` metres high (leaf_scale is in metres of its own)."""
        key = seed_key(seed)
        tree = _tree_rule(values, *two(child_key(key, 2)), *two(child_key(key, 3)))
        told = [*tree, *(number for level in range(int(tree.levels)) for number in _level_rule(values, level))]
        numbers, integers = np.empty((4, budget.vertices), np.float32), np.empty((2, budget.vertices), np.int32)
        leaves = np.empty((11, budget.leaves), np.float32)
        scratch, picks = _SCRATCH.room(budget.vertices)  # a clone has one of its own at least
        n, k, cut = grow(np.array(told, np.float64), key, scratch, picks, numbers, integers, leaves)
        numbers, leaves = numbers.T[:n], leaves.T[:k]
        look = Look(int(values["lobes"]), float(values["lobe_depth"]), str(values["leaf_shape"]))
        return Plant(numbers[:, :3], numbers[:, 3], integers[0, :n], integers[1, :n], leaves[:, :3], leaves[:, 3:6],
                     leaves[:, 6:9], leaves[:, 9:], cut, look)  # fmt: skip


def _tree_rule(v: Mapping[str, Any], u1: float, u2: float, u3: float, _: float) -> TreeRule:
    """Rule of the whole tree; the draws in [0, 1) vary height, length and radius of the trunk."""
    height = max(v["scale"] + v["scale_v"] * (2 * u1 - 1), SMALLEST * v["scale"])
    length = max(v["length_0"] + v["length_v_0"] * (2 * u2 - 1), 0.05) * height
    radius = length * v["ratio"] * max(v["scale_0"] + v["scale_v_0"] * (2 * u3 - 1), 0.05)
    return TreeRule(
        v["levels"], v["shape"], height, v["base_size"], length, radius, v["flare"], v["base_splits"], v["ratio_power"],
        v["attraction_up"], v["prune_ratio"], v["prune_width"], v["prune_width_peak"], v["prune_power_low"],
        v["prune_power_high"], v["leaf_scale"], v["leaf_scale"] * v["leaf_scale_x"], v["leaf_bend"],
    )  # fmt: skip


def _level_rule(v: Mapping[str, Any], n: int) -> LevelRule:
    """Rule of the stems of level `n` and of where their children begin; angles become turns."""
    leafy, child = n == v["levels"] - 1, min(n + 1, LEVELS - 1)
    segments = float(v[f"curve_res_{n}"])
    curve, back, curve_v = v[f"curve_{n}"] * _TURN, v[f"curve_back_{n}"] * _TURN, v[f"curve_v_{n}"] * _TURN
    halves = (curve / segments, curve / segments) if back == 0 else (2 * curve / segments, 2 * back / segments)
    bare = v["base_size"] * v["scale"] / max(v["length_0"] * v["scale"], 1e-6) if n == 0 else v[f"base_size_{n}"]
    return LevelRule(
        segments, *halves, -curve_v if curve_v < 0 else curve_v / segments, curve_v < 0,
        v[f"bend_v_{n}"] * _TURN / segments,
        v[f"taper_{n}"], v[f"seg_splits_{n}"], v[f"split_angle_{n}"] * _TURN, v[f"split_angle_v_{n}"] * _TURN,
        min(bare, 0.99), v["leaves"] if leafy else v[f"branches_{child}"], 1 if leafy else v[f"whorl_{child}"],
        v[f"down_angle_{child}"] * _TURN, v[f"down_angle_v_{child}"] * _TURN,
        v[f"rotate_{child}"] * _TURN, v[f"rotate_v_{child}"] * _TURN,
        v[f"length_{child}"], v[f"length_v_{child}"], v[f"radius_mod_{child}"],
    )  # fmt: skip
