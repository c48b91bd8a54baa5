"""Splits: stems that fork into clones of themselves (sec. 4.2).

The rule: how many clones a segment ends with is diffused over the segments of each stem, from a random start, so that
the mean is exact. At a split the stem and its clones all pitch by split_angle less their angle to the vertical; then
each clone turns about the vertical, by the paper's 20 + 0.75 (30 + |declination - 90|) u^2 degrees to either side;
clones of base_splits stand evenly around. What they pitched is undone over the segments that are left. A clone is no
new stem: the children of a stem are shared among its clones, and its number of them stays what it was.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.weberpenn.rules import SPLIT
from generators.weberpenn.stems import BACK, BLOCK, COUNT, DUE, DZ, FLOATS, INTS, MADE, frame_of, put_frame
from generators.weberpenn.turning import about_vertical, arccos, pitched
from treefit.plant.compiling import INNER
from treefit.plant.streams import child_key, circle, two

_ZERO, _HALF, _ONE, _TWO = (np.float32(x) for x in (0.0, 0.5, 1.0, 2.0))
_TURN, _DEGREE = np.float32(0.5 / math.pi), np.float32(1.0 / 360.0)
_20, _30, _90, _SHARE = (np.float32(x) for x in (20.0, 30.0, 90.0, 0.75))


@njit(**INNER)
def split(rule, level, base_splits, segment, stems, m):
    """Split the first `m` stems at the end of `segment`; return (stems, whether there was no room for all clones)."""
    at_base = base_splits if level == 0 and segment == 1 else 0
    for s in range(m):
        b, at = s // BLOCK, s % BLOCK
        block = stems.numbers[b]
        due = block[DUE + at] + np.float32(rule.splits)
        clones = int(due) + at_base
        block[DUE + at] = due - np.float32(int(due))
        if clones == 0:
            continue
        if m + clones > stems.keys.size:
            return m, True
        key = child_key(stems.keys[b, at], SPLIT + segment)
        u, _ = two(key)
        _pitch(rule, segment, block, at, u)
        block[COUNT + at] /= np.float32(clones + 1)
        for clone in range(clones):
            _put_clone(stems, s, m, child_key(key, clone), clone, clones, at_base > 0)
            m += 1
    return m, False


@njit(**INNER)
def _pitch(rule, segment, block, at, u):
    """Pitch a stem for its split, and have it bend back over the segments that are left."""
    angle = np.float32(rule.split_angle) + np.float32(rule.split_angle_v) * (_TWO * u - _ONE)
    angle = max(angle - _TURN * arccos(block[DZ + at]), _ZERO)
    block[BACK + at] -= angle / (np.float32(rule.segments) - np.float32(segment))
    c, w = circle(angle)
    put_frame(block, at, *pitched(*frame_of(block, at), c, w, _ONE, _ZERO))


@njit(**INNER)
def _put_clone(stems, s, m, key, clone, clones, at_base):
    """Put a clone of stem `s` as stem `m`, turned about the vertical."""
    source, column = stems.numbers[s // BLOCK], s % BLOCK
    block, at = stems.numbers[m // BLOCK], m % BLOCK
    for row in range(0, FLOATS, BLOCK):
        block[row + at] = source[row + column]
    for row in range(0, INTS, BLOCK):
        stems.vertices[m // BLOCK, row + at] = stems.vertices[s // BLOCK, row + column]
    stems.keys[m // BLOCK, at] = key
    u, side = two(key)
    block[DUE + at], block[MADE + at] = two(child_key(key, 0))
    dx, dy, dz, ax, ay, az = frame_of(source, column)
    if at_base:
        turn = (np.float32(clone) + _ONE + _HALF * (u - _HALF)) / np.float32(clones + 1)
    else:
        declination = arccos(dz) * _TURN / _DEGREE
        turn = math.copysign(_DEGREE, side - _HALF) * (_20 + _SHARE * (_30 + abs(declination - _90)) * u * u)
    c, w = circle(turn)
    put_frame(block, at, *about_vertical(dx, dy, dz, c, w), *about_vertical(ax, ay, az, c, w))
