"""Parameters of Weber and Penn 1995, by the paper's names in snake case with the level at the end.

1DownAngleV is down_angle_v_1. Level 0 is the trunk; leaves take the angles of the level after the last. Angles are in
degrees; a `v` is a variation, half the width of an interval around the value. Those of ADDED came after the paper.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from treefit.plant import LEAF_SHAPES, Parameter, ParameterSpace, Value

LEVELS = 4
"""Levels of stems at most; leaves and children deeper than that would take the parameters of the last (sec. 4.9)."""


def _number(name: str, low: float, high: float, default: float, unit: str, doc: str, log: bool = False) -> Parameter:
    return Parameter(name, low, high, default, unit, "log" if log else "linear", "float", doc=doc)


def _count(name: str, low: int, high: int, default: int, doc: str) -> Parameter:
    return Parameter(name, low, high, default, "1", "linear", "int", doc=doc)


_TREE = (
    _count("shape", 0, 8, 7, "outline of the crown: 0 cone, 1 sphere, 2 half sphere, 3 cylinder, 4 tapered cylinder, "
           "5 flame, 6 inverse cone, 7 tend flame, 8 the envelope of the pruning (sec. 4.3)"),
    _number("base_size", 0.02, 0.9, 0.4, "share", "bare part of the trunk, by the tree's height (sec. 4.3)"),
    _number("scale", 2, 40, 13, "m", "height of the tree, before length_0 (sec. 4.3)"),
    _number("scale_v", 0, 10, 0, "m", "variation of it (sec. 4.3)"),
    _count("levels", 2, LEVELS, 3, "levels of stems, the trunk included; leaves are on the last (sec. 4)"),
    _number("ratio", 0.005, 0.06, 0.015, "share", "radius of the trunk by its length (sec. 4.4)", log=True),
    _number("ratio_power", 0.8, 2.2, 1.2, "1", "how a child's radius follows its length by its parent's (sec. 4.4)"),
    _count("lobes", 0, 12, 5, "lobes of the trunk's section (sec. 4.4)"),
    _number("lobe_depth", 0, 0.3, 0.07, "share", "how deep they are, by the radius (sec. 4.4)"),
    _number("flare", 0, 1.5, 0.6, "share", "how much wider the foot of the trunk is (sec. 4.4)"),
    _number("leaves", -60, 60, 25, "1", "leaves of a stem of the last level; below 0 a fan at its tip (sec. 4.6)"),
    Parameter("leaf_shape", default="broad", kind="choice", choices=LEAF_SHAPES, doc="outline of a leaf (sec. 4.6)"),
    _number("leaf_scale", 0.05, 1.0, 0.17, "m", "length of a leaf (sec. 4.6)", log=True),
    _number("leaf_scale_x", 0.05, 1.5, 1.0, "share", "width of a leaf by its length (sec. 4.6)"),
    _number("leaf_bend", 0, 1, 0.3, "share", "how far leaves turn to the light, out and up (sec. 4.9)"),
    _number("attraction_up", -4, 4, 0.5, "1", "turn of stems from level 2 on to the sky, below 0 to the ground (4.8)"),
    _number("prune_ratio", 0, 1, 0, "share", "how strictly stems keep to the envelope (sec. 4.7)"),
    _number("prune_width", 0, 1, 0.5, "share", "greatest radius of the envelope by the tree's height (sec. 4.7)"),
    _number("prune_width_peak", 0.05, 0.95, 0.5, "share", "how high in the envelope it is (sec. 4.7)"),
    _number("prune_power_low", 0, 1.5, 0.5, "1", "bulge of the envelope under its peak: 1 a cone, <1 fuller (4.7)"),
    _number("prune_power_high", 0, 1.5, 0.5, "1", "the same over its peak (sec. 4.7)"),
)  # fmt: skip

_TRUNK = (
    _number("scale_0", 0.5, 2, 1, "1", "factor of the trunk's radius (sec. 4.4)"),
    _number("scale_v_0", 0, 0.5, 0, "1", "variation of it (sec. 4.4)"),
    _number("length_0", 0.6, 1.1, 1, "share", "length of the trunk by the tree's height (sec. 4.3)"),
    _count("base_splits", 0, 3, 0, "clones of the trunk after its first segment (sec. 4.2)"),
)


def _every(n: int) -> tuple[Parameter, ...]:
    """Parameters that every level has."""
    what = "the trunk" if n == 0 else f"a stem of level {n}"
    return (
        _number(f"length_v_{n}", 0, 0.5, 0, "share", f"variation of length_{n} (sec. 4.3)"),
        _number(f"taper_{n}", 0, 3, 1, "1",
                f"form of {what}: 0 cylinder, 1 cone, 2 rounded end, 3 spheres (sec. 4.4)"),
        _number(f"seg_splits_{n}", 0, 1.5, 0, "1", f"mean count of clones at each segment of {what} (sec. 4.2)"),
        _number(f"split_angle_{n}", 0, 80, 20, "deg", f"angle by which {what} and its clones part (sec. 4.2)"),
        _number(f"split_angle_v_{n}", 0, 30, 0, "deg", f"variation of split_angle_{n} (sec. 4.2)"),
        _count(f"curve_res_{n}", 1, 20, (8, 6, 4, 2)[n], f"segments of {what} (sec. 4.1)"),
        _number(f"curve_{n}", -180, 180, 0, "deg",
                f"turn of {what} from base to tip, down; or of its first half (sec. 4.1)"),
        _number(f"curve_back_{n}", -180, 180, 0, "deg", f"turn of its second half; 0: curve_{n} is all (sec. 4.1)"),
        _number(f"curve_v_{n}", -200, 300, 20, "deg",
                "random turn, summed over the segments; below 0 the angle of a helix (sec. 4.1)"),
        _number(f"bend_v_{n}", 0, 200, 0, "deg", "the same to the side"),
    )  # fmt: skip


def _child(n: int) -> tuple[Parameter, ...]:
    """Parameters that levels have which begin on another."""
    parent = "the trunk" if n == 1 else f"a stem of level {n - 1}"
    down, turn, number, length = ((60, 140, 40, 0.4), (45, 140, 15, 0.5), (45, 140, 6, 0.4))[n - 1]
    return (
        _number(f"down_angle_{n}", -20, 150, down, "deg", f"between {parent} and what grows on it (sec. 4.3)"),
        _number(f"down_angle_v_{n}", -80, 60, 0, "deg",
                "random variation of it; below 0 from the base, plus, to the tip, minus (sec. 4.3)"),
        _number(f"rotate_{n}", -180, 180, turn, "deg",
                f"turn around {parent} from one child to the next; below 0 both sides in turn (sec. 4.3)"),
        _number(f"rotate_v_{n}", 0, 90, 0, "deg", "variation of it (sec. 4.3)"),
        _number(f"branches_{n}", 0, 300, number, "1", f"most children of {parent} (sec. 4.3)"),
        _number(f"length_{n}", 0.02, 2, length, "share", f"longest child by the length of {parent} (sec. 4.3)"),
        *_every(n),
        _number(f"radius_mod_{n}", 0.1, 1, 1, "1", "factor of the radius"),
        _number(f"base_size_{n}", 0, 0.8, 0, "share", f"bare part of a stem of level {n}"),
        _count(f"whorl_{n}", 1, 8, 1, f"children at one place of {parent}, spread evenly around it"),
    )  # fmt: skip


_LIMITS: dict[str, tuple[float, float]] = {
    "shape": (0, 8), "base_size": (0, 0.99), "scale": (0.01, 1e4), "levels": (1, LEVELS), "lobes": (0, 100),
    "lobe_depth": (0, 0.99), "taper": (0, 3), "curve_res": (1, 1000), "whorl": (1, 100), "base_splits": (0, 100),
    "leaf_bend": (0, 1), "prune_ratio": (0, 1), "prune_width_peak": (0.01, 0.99),
}  # fmt: skip
_ANY_SIGN = (
    "leaves", "branches", "attraction_up", "curve", "curve_back", "curve_v", "down_angle", "down_angle_v", "rotate",
)  # fmt: skip


def _limited(parameter: Parameter) -> Parameter:
    """The same with the limits of what can grow: nothing is below 0 but angles, fans and attraction."""
    name = parameter.name.rstrip("0123").rstrip("_")
    if parameter.kind == "choice" or name in _ANY_SIGN:
        return parameter
    least, most = _LIMITS.get(name, (0.0, math.inf))
    return replace(parameter, least=least, most=most)


PARAMETERS = tuple(
    _limited(one) for one in (*_TREE, *_TRUNK, *_every(0), *(one for n in range(1, LEVELS) for one in _child(n)))
)
ADDED = (
    "leaf_shape", *(f"bend_v_{n}" for n in range(LEVELS)),
    *(f"{name}_{n}" for name in ("radius_mod", "base_size", "whorl") for n in range(1, LEVELS)),
)  # fmt: skip
"""Parameters that are not the paper's; at their defaults they do nothing."""

UNSEEN: Mapping[str, Value] = {"scale_v": 0.0, "lobes": 5, "lobe_depth": 0.07, "leaf_shape": "broad"}
"""No search has these as genes, presets set them: no mask sees them, and scale_v does what leaf_scale does."""

FULL = ParameterSpace(PARAMETERS, {**UNSEEN, "scale": 13.0})
"""Everything free that a mask can see; `scale` only sets the size in metres."""
