"""Rules of WeberPennGen: what its kernels are told of the tree and of each level. All are floats, angles in turns."""

from __future__ import annotations

from typing import NamedTuple


class LevelRule(NamedTuple):
    """How the stems of one level grow, and where their children, stems or leaves, begin."""

    segments: float  # nCurveRes
    curve: float  # turns a segment of the first half
    curve_back: float  # turns a segment of the second half
    curve_v: float  # turns a segment; the cone angle of a helix
    helix: float  # 1 when stems are helices
    bend_v: float  # turns a segment
    taper: float
    splits: float  # clones a segment
    split_angle: float
    split_angle_v: float
    bare: float  # share without children
    children: float  # most of a stem; below 0 a fan at its tip
    whorl: float  # children at one place
    down_angle: float  # of the children
    down_angle_v: float
    rotate: float
    rotate_v: float
    length: float  # of the children by that of the stem; unused for leaves
    length_v: float
    radius: float  # factor of the children's


class TreeRule(NamedTuple):
    """What concerns the whole tree; lengths in m."""

    levels: float
    shape: float
    height: float  # without the factor length_0
    bare: float  # share of the height
    length: float  # of the trunk
    radius: float  # of the trunk
    flare: float
    base_splits: float
    ratio_power: float
    attraction: float
    prune_ratio: float
    prune_width: float
    prune_peak: float
    prune_low: float
    prune_high: float
    leaf_length: float
    leaf_width: float
    leaf_bend: float


COUNTED, SEGMENT, SPLIT, CHILD = 40, 1, 48, 96
"""Numbers of the keyed draws of a stem: of the count of its leaves; the first of its segments, clones and children."""
