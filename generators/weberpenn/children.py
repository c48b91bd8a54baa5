"""Children of a level's stems: which begin where on a segment, and the stems of the next level that they become."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.weberpenn.picks import PLACE, PX, PY, PZ, SPIN
from generators.weberpenn.power import power
from generators.weberpenn.rules import COUNTED
from generators.weberpenn.shapes import shape_ratio, unit_taper
from generators.weberpenn.stems import (
    BACK,
    BEFORE,
    BEGIN,
    BLOCK,
    COUNT,
    DUE,
    FILL,
    LONG,
    MADE,
    NOW,
    PARENT,
    STEM,
    THICK,
    TURN,
    X,
    Y,
    Z,
    frame_of,
    put_frame,
)  # fmt: skip
from generators.weberpenn.turning import placed
from treefit.plant.compiling import INNER
from treefit.plant.streams import child_key, circle, two

_ZERO, _ONE, _TWO, _SMALL = (np.float32(x) for x in (0.0, 1.0, 2.0, 1e-5))
_FIRST, _BIT = np.float32(0.50002), np.float32(1e-3)
"""A half, and what counts get before they are rounded down: a bit over, so that errors of rounding have no say."""
_0_2, _0_5, _0_6, _0_8, _1_6 = (np.float32(x) for x in (0.2, 0.5, 0.6, 0.8, 1.6))


@njit(**INNER)
def count_children(rule, level, leafy, block, keys, count):
    """Set how many children the stems of a block should have, whole numbers (sec. 4.3 and 4.6); return the sum.

    Stems are rounded down; of leaves, which may be few, a share of the stems has one more, so that the mean is exact.
    """
    most, total = np.float32(rule.children), np.int64(0)
    base, slope, row = _ONE, _ZERO, BEGIN
    if leafy:
        base, slope = _0_5, _0_5  # ShapeRatio(4)
    elif level == 1:
        base, slope, row = _0_2, _0_8, FILL
    elif level > 1:
        slope = -_0_5
    for s in range(count):
        number = abs(most) * (base + slope * block[row + s])
        number += two(child_key(keys[s], COUNTED))[0] if leafy else _BIT
        whole = np.int32(number)
        total += whole
        block[COUNT + s] = math.copysign(np.float32(whole), most)
        block[MADE + s] = _FIRST
    return total


@njit(**INNER)
def down_angle(rule, place, u):
    """Turn of a child from its parent (sec. 4.3): with random variation, or with one along the parent."""
    if rule.down_angle_v >= 0:
        return np.float32(rule.down_angle) + np.float32(rule.down_angle_v) * (_TWO * u - _ONE)
    left = (_ONE - place) / (_ONE - np.float32(rule.bare))
    return np.float32(rule.down_angle) + np.float32(rule.down_angle_v) * (_0_6 - _1_6 * left)


@njit(**INNER)
def put_stems(rule, tree, level, parents, b, picked, work, owners, twigs, children, m):
    """Put the picked children of block `b` as stems behind the first `m` of `children`; return (stems, no room)."""
    block, fan, whorl = parents.numbers[b], rule.children < 0, 1 if rule.children < 0 else int(rule.whorl)
    bare = np.float32(rule.bare)
    for i in range(picked):
        s, place = owners[i], work[PLACE + i]
        fill = _ONE - _0_6 * place
        if level == 0:
            fill = np.float32(shape_ratio(int(tree.shape), (_ONE - place) / (_ONE - bare), tree))
        there = block[THICK + s] * (_ONE - unit_taper(rule.taper) * place)
        for w in range(whorl):
            if m >= children.keys.size:
                return m, True
            key = child_key(twigs[i], w)
            u, v = two(key)
            due, turn = two(child_key(key, 0))
            long = np.float32(rule.length) + np.float32(rule.length_v) * (_TWO * v - _ONE)
            long = max(block[LONG + s] * fill * long, _SMALL)
            at, target = m % BLOCK, children.numbers[m // BLOCK]
            c, z = circle(down_angle(rule, place, u))
            p, q = circle(work[SPIN + i] + np.float32(w) / np.float32(whorl))
            put_frame(target, at, *placed(*frame_of(block, s), p, q, c, z, fan))
            target[X + at], target[Y + at] = work[PX + i], work[PY + i]
            target[Z + at] = max(work[PZ + i], _ZERO)
            thick = block[THICK + s] * power(long / block[LONG + s], np.float32(tree.ratio_power))
            target[LONG + at], target[THICK + at] = long, np.float32(rule.radius) * min(thick, there)
            target[BEGIN + at], target[FILL + at] = place, fill
            target[TURN + at], target[BACK + at], target[DUE + at] = turn, _ZERO, due
            vertices = children.vertices[m // BLOCK]
            vertices[PARENT + at], vertices[STEM + at] = parents.vertices[b, BEFORE + s], m
            vertices[NOW + at] = vertices[BEFORE + at] = 0
            children.keys[m // BLOCK, at] = key
            m += 1
    return m, False
