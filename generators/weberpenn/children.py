"""Children of a level's stems: which begin where on a segment, and the stems of the next level that they become."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.compiling import INNER
from generators.weberpenn.rules import CHILD, COUNTED
from generators.weberpenn.shapes import shape_ratio, unit_taper
from generators.weberpenn.stems import (
    BACK,
    BEFORE,
    BEGIN,
    BLOCK,
    COUNT,
    DUE,
    DX,
    DY,
    DZ,
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
from treefit.plant.streams import child_key, circle, two

PLACE, SPIN, FREE = 0, BLOCK, 2 * BLOCK
"""Rows of the picks' numbers: share of the stem where a child begins, turn around it; the first free row."""
_ZERO, _HALF, _ONE, _TWO, _SMALL = (np.float32(x) for x in (0.0, 0.5, 1.0, 2.0, 1e-5))
_0_2, _0_5, _0_6, _0_8, _1_6 = (np.float32(x) for x in (0.2, 0.5, 0.6, 0.8, 1.6))


@njit(**INNER)
def count_children(rule, level, leafy, block, keys, count):
    """How many children the stems of a block should have, whole numbers (sec. 4.3 and 4.6).

    Stems are rounded down; of leaves, which may be few, a share of the stems has one more, so that the mean is exact.
    """
    most = np.float32(rule.children)
    for s in range(count):
        share = _ONE
        if leafy:
            share = _0_5 + _0_5 * block[BEGIN + s]  # ShapeRatio(4)
        elif level == 1:
            share = _0_2 + _0_8 * block[FILL + s]
        elif level > 1:
            share = _ONE - _0_5 * block[BEGIN + s]
        number = abs(most) * share + _SMALL
        if leafy:
            number += two(child_key(keys[s], COUNTED))[0]
        block[COUNT + s] = math.copysign(np.float32(math.floor(number)), most)
        block[MADE + s] = _HALF


@njit(**INNER)
def pick(rule, key, start, end, last, block, s, child, work, owners, keys, picked):
    """List the children of stem `s` between the shares `start` and `end` of its length behind `picked` others.

    Return their count and the number of the `child` from which to go on when the list was full, 0 when it was not.
    """
    if rule.children < 0:
        return _pick_fan(rule, key, block, s, work, owners, keys, picked) if last else (picked, 0)
    bare, whorl = np.float32(rule.bare), int(rule.whorl)
    rate = block[COUNT + s] / ((_ONE - bare) * np.float32(whorl))
    low, made = max(start, bare), block[MADE + s]
    after = made + rate * max(end - low, _ZERO)
    for each in range(max(child, int(made) + 1), int(after) + 1):
        if picked + whorl > BLOCK:
            return picked, each
        twig = child_key(key, CHILD + each)
        u, _ = two(twig)
        turn = np.float32(rule.rotate) + np.float32(rule.rotate_v) * (_TWO * u - _ONE)
        if rule.rotate >= 0:  # on from the last
            turn += block[TURN + s]
            turn -= np.float32(int(turn))
            block[TURN + s] = turn
        else:  # one side and the other in turn
            turn = _HALF + turn if each % 2 == 0 else -_HALF - turn
        place = low + (np.float32(each) - made) / rate
        for w in range(whorl):
            work[PLACE + picked], owners[picked] = place, s
            work[SPIN + picked] = turn + np.float32(w) / np.float32(whorl)
            keys[picked] = child_key(twig, w)
            picked += 1
    block[MADE + s] = after
    return picked, 0


@njit(**INNER)
def _pick_fan(rule, key, block, s, work, owners, keys, picked):
    """List the children of a stem that stand in a fan of `rotate` turns at its tip, when there is room for all."""
    number = min(int(-block[COUNT + s]), BLOCK)
    if picked + number > BLOCK:
        return picked, 1
    for child in range(number):
        twig = child_key(key, CHILD + child)
        u, _ = two(twig)
        at = np.float32(child) / np.float32(max(number - 1, 1)) - _HALF
        work[PLACE + picked], owners[picked], keys[picked] = _ONE, s, twig
        work[SPIN + picked] = np.float32(rule.rotate) * at + np.float32(rule.rotate_v) * (_TWO * u - _ONE)
        picked += 1
    return picked, 0


@njit(**INNER)
def down_angle(rule, place, u):
    """Turn of a child from its parent (sec. 4.3): with random variation, or with one along the parent."""
    if rule.down_angle_v >= 0:
        return np.float32(rule.down_angle) + np.float32(rule.down_angle_v) * (_TWO * u - _ONE)
    left = (_ONE - place) / (_ONE - np.float32(rule.bare))
    return np.float32(rule.down_angle) + np.float32(rule.down_angle_v) * (_0_6 - _1_6 * left)


@njit(**INNER)
def put_stems(rule, tree, level, end, parents, b, picked, work, owners, keys, children, m):
    """Put the picked children of block `b` as stems behind the first `m` of `children`; return (stems, no room)."""
    block, fan = parents.numbers[b], rule.children < 0
    bare = np.float32(rule.bare)
    for i in range(picked):
        if m >= children.keys.size:
            return m, True
        s, place = owners[i], work[PLACE + i]
        u, v = two(keys[i])
        due, turn = two(child_key(keys[i], 0))
        fill = _ONE - _0_6 * place
        if level == 0:
            fill = np.float32(shape_ratio(int(tree.shape), (_ONE - place) / (_ONE - bare), tree))
        long = np.float32(rule.length) + np.float32(rule.length_v) * (_TWO * v - _ONE)
        long = max(block[LONG + s] * fill * long, _SMALL)
        at, target = m % BLOCK, children.numbers[m // BLOCK]
        c, w = circle(down_angle(rule, place, u))
        p, q = circle(work[SPIN + i])
        put_frame(target, at, *placed(*frame_of(block, s), p, q, c, w, fan))
        back = (end - place) * block[LONG + s]
        target[X + at] = block[X + s] - back * block[DX + s]
        target[Y + at] = block[Y + s] - back * block[DY + s]
        target[Z + at] = max(block[Z + s] - back * block[DZ + s], _ZERO)
        there = block[THICK + s] * (_ONE - unit_taper(rule.taper) * place)
        thick = block[THICK + s] * np.float32((long / block[LONG + s]) ** tree.ratio_power)
        target[LONG + at], target[THICK + at] = long, np.float32(rule.radius) * min(thick, there)
        target[BEGIN + at], target[FILL + at] = place, fill
        target[TURN + at], target[BACK + at], target[DUE + at] = turn, _ZERO, due
        vertices = children.vertices[m // BLOCK]
        vertices[PARENT + at], vertices[STEM + at] = parents.vertices[b, BEFORE + s], m
        vertices[NOW + at] = vertices[BEFORE + at] = 0
        children.keys[m // BLOCK, at] = keys[i]
        m += 1
    return m, False
