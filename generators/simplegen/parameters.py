"""Parameters of SimpleGen: the paper's 19 and the few that let it express the crowns of real trees.

Lengths other than branch_len_0 are shares, so that branch_len_0 alone sets the size in metres, which no picture shows.
"""

from __future__ import annotations

from generators.simplegen.crown import KNOTS
from treefit.plant import Parameter, ParameterSpace

LEVELS = 4


def _number(name: str, low: float, high: float, default: float, unit: str, doc: str, log: bool = False) -> Parameter:
    return Parameter(name, low, high, default, unit, "log" if log else "linear", "float", doc=doc)


def _count(name: str, low: int, high: int, default: int, doc: str, log: bool = False) -> Parameter:
    return Parameter(name, low, high, default, "1", "log" if log else "linear", "int", doc=doc)


_KNOT_LOW, _KNOT_DEFAULT = (0.0, 0.1, 0.1, 0.05, 0.0), (0.5, 0.9, 1.0, 0.75, 0.2)


def _knot(side: str, knot: int) -> Parameter:
    """Half width of the crown at one of the heights at which it is told, from the bottom up."""
    height = ("at its bottom", "a quarter up", "in its middle", "three quarters up", "at its top")[knot]
    doc = f"how wide the crown is to the {side} {height}, by branch_len_1"
    return _number(f"crown_{side}_{knot}", _KNOT_LOW[knot], 1.0, _KNOT_DEFAULT[knot], "share", doc)


_PAPER = (
    _number("branch_len_0", 2, 40, 10, "m", "length of the trunk"),
    _number("branch_len_1", 0.12, 1.2, 0.4, "share", "longest limb, half of the crown's width, by the trunk", log=True),
    _number("branch_len_2", 0.2, 0.9, 0.4, "share", "length of level 2 by that of its parent", log=True),
    _number("branch_len_3", 0.2, 0.9, 0.4, "share", "length of level 3 by that of its parent", log=True),
    _number("branch_r_0", 0.006, 0.1, 0.018, "share", "radius of the trunk's base by its length", log=True),
    _number("branch_r_1", 0.12, 0.6, 0.35, "share", "base radius of level 1 by its parent's there"),
    _number("branch_r_2", 0.2, 0.8, 0.5, "share", "base radius of level 2 by its parent's there"),
    _number("branch_r_3", 0.2, 0.9, 0.5, "share", "base radius of level 3 by its parent's there"),
    _number("branch_angle_0", 0.3, 2.2, 1.0, "rad", "angle between the trunk and its lowest branches"),
    _number("branch_angle_1", 0.15, 1.6, 0.8, "rad", "angle between a branch of level 1 and its children"),
    _number("branch_angle_2", 0.15, 1.6, 0.8, "rad", "angle between a branch of level 2 and its children"),
    _number("branch_angle_3", 0.15, 1.6, 0.8, "rad", "angle between a branch of level 3 and its leaves"),
    _count("branch_count_0", 4, 40, 14, "joints of the branching part of the trunk", log=True),
    _count("branch_count_1", 3, 10, 5, "joints of the branching part of level 1", log=True),
    _count("branch_count_2", 2, 7, 4, "joints of the branching part of level 2", log=True),
    _count("branch_count_3", 1, 4, 3, "joints of the leafy part of level 3"),
    _number("branching_start_0", 0.02, 0.92, 0.25, "share", "bare part of the trunk"),
    _number("branching_start_1", 0.0, 0.6, 0.2, "share", "bare part of a branch of level 1"),
    _number("branching_start_2", 0.0, 0.5, 0.1, "share", "bare part of a branch of level 2"),
    _number("branching_start_3", 0.0, 0.5, 0.0, "share", "part of a branch of level 3 that has no leaves"),
    _number("leaves_count", 0.2, 1.0, 0.75, "share", "probability of each leaf"),
    _number("leaf_size", 0.012, 0.06, 0.022, "share", "length of a leaf by that of the trunk", log=True),
)

_ADDED = (
    _count("levels", 3, 4, 4, "levels of branches, the trunk included"),
    _count("whorl", 1, 5, 2, "branches at each joint of the trunk"),
    *(_knot(side, knot) for side in ("left", "right") for knot in range(KNOTS)),
    _number("crown_depth", 0.4, 1.0, 1.0, "share", "depth of the crown by its width"),
    _number("crown_hang", 0.0, 1.0, 0.1, "share", "how far the crown hangs below the lowest limb, by the bare trunk"),
    _number("crown_rise", 0.0, 0.5, 0.05, "share", "how far the crown rises over the trunk, by the trunk"),
    _number("crown_keep", 0.5, 1.0, 0.9, "share", "how strictly branches keep to the crown"),
    _number(
        "branch_angle_change", -1.0, 0.4, -0.4, "rad", "what branch_angle_0 gains from the crown's bottom to its top"
    ),
    _number("length_variation", 0.0, 0.5, 0.2, "share", "random variation of the length of branches"),
    _number(
        "shortening", 0.0, 0.9, 0.5, "share", "how much shorter children are at the tip of a branch than at its base"
    ),
    _number("lean", -0.2, 0.2, 0.0, "rad", "angle of the trunk's base to the vertical, to the right"),
    _number("trunk_bend", -0.35, 0.35, 0.0, "rad", "turn of the trunk from base to tip, to the right"),
    _number("trunk_taper", 0.03, 1.0, 0.3, "share", "radius at the tip of the trunk by that at its base"),
    _number("taper", 0.03, 0.7, 0.3, "share", "radius at the tip of a branch by that at its base"),
    _number("droop_1", -1.5, 1.5, 0.0, "rad", "turn of level 1 from base to tip, upwards"),
    _number("droop_2", -1.5, 1.5, 0.0, "rad", "turn of deeper levels from base to tip, upwards"),
    _number("wobble", 0.0, 0.4, 0.15, "rad", "random turn at every joint"),
    _count("leaf_number", 0, 8, 3, "leaves at each joint; 0 is a winter tree"),
    _number("leaf_width", 0.15, 1.0, 0.5, "share", "width of a leaf by its length"),
)

NEUTRAL = {
    "levels": 4, "whorl": 1, **{f"crown_{side}_{knot}": 1.0 for side in ("left", "right") for knot in range(KNOTS)},
    "crown_depth": 1.0, "crown_hang": 0.0, "crown_rise": 0.0, "crown_keep": 0.0, "branch_angle_change": 0.0,
    "length_variation": 0.0, "shortening": 0.0, "lean": 0.0, "trunk_bend": 0.0, "trunk_taper": 0.3, "taper": 0.3,
    "droop_1": 0.0, "droop_2": 0.0, "wobble": 0.0, "leaf_number": 1, "leaf_width": 1.0,
}  # fmt: skip
"""Values of the additions at which SimpleGen is the paper's."""

SPACE = ParameterSpace((*_PAPER, *_ADDED))

FIXED = {"branch_len_0": 10.0, "branch_r_2": 0.5, "branch_r_3": 0.5, "branching_start_3": 0.0, "leaf_width": 0.5}
"""Not searched: no picture shows metres or the radius of twigs; the others do what a neighbour does."""
