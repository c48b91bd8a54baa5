"""Picks: the places on a block of stems where children begin, listed so that vector instructions can make them."""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.weberpenn.rules import CHILD
from generators.weberpenn.stems import BLOCK, COUNT, LONG, MADE, TURN, X, Y, Z, frame_of
from treefit.plant.compiling import INNER, ONCE
from treefit.plant.streams import child_key, two

LANES = 16
"""Places of a stem are written so many at a time, for vector instructions; what is too many is written over."""
ROW = BLOCK + LANES
PLACE, SPIN, PX, PY, PZ, PDX, PDY, PDZ, PAX, PAY, PAZ, FREE = (ROW * row for row in range(12))
"""Rows of the picks' numbers: share of the stem, turn around it; position, direction of the stem and axis of its bends;
the first free row."""
_ZERO, _HALF, _ONE, _TWO = (np.float32(x) for x in (0.0, 0.5, 1.0, 2.0))


@njit(**INNER)
def pick(rule, low, high, block, keys, width, s, child, work, owners, twigs):
    """List the places between the shares `low` and `high` of a block's stems where children begin, from stem `s` on.

    Return their count and, for when the list was full, the stem and the number of its child from which to go on.
    """
    fan, bare, rate, picked = rule.children < 0, np.float32(rule.bare), _ZERO, np.int64(0)
    from_bare, whorl = max(low, bare), np.float32(rule.whorl)
    while s < width:
        if fan:
            made = after = -_ONE
            last = np.int64(-block[COUNT + s]) - 1 if high >= _ONE else np.int64(-1)
        else:
            rate, made = block[COUNT + s] / ((_ONE - bare) * whorl), block[MADE + s]
            after = made + rate * max(high - from_bare, _ZERO)
            last = np.int64(after)
        first = max(child, np.int64(made) + 1)
        count = min(last + 1 - first, BLOCK - picked)
        if count > 0:
            _spread(
                rule, from_bare, high, made, rate, last, block, keys[s], s, first, picked, count, work, owners, twigs
            )
            picked += count
        child = first + max(count, 0)
        if child <= last:
            break
        block[MADE + s] = after
        s, child = s + 1, np.int64(0)
    if not fan and rule.rotate >= 0:
        _turn_on(block, picked, work, owners)
    return picked, s, child


@njit(**ONCE)
def _spread(rule, low, high, made, rate, last, block, key, s, first, picked, count, work, owners, twigs):
    """List `count` places of stem `s` from the child number `first` on, behind the `picked` ones."""
    fan, aside, long = rule.children < 0, np.int32(rule.rotate < 0), block[LONG + s]
    x, y, z = block[X + s], block[Y + s], block[Z + s]
    dx, dy, dz, ax, ay, az = frame_of(block, s)
    rotate, rotate_v = np.float32(rule.rotate), np.float32(rule.rotate_v)
    slope, level, step = _ZERO, rotate, _ZERO
    if fan:
        slope, level, low, made, aside = rotate / np.float32(max(last, 1)), -_HALF * rotate, _ONE, _ZERO, np.int32(0)
    else:
        step = _ONE / rate
        if aside:
            level += _HALF
    for start in range(picked, picked + count, LANES):
        to, whose, keys = work[start:], owners[start:], twigs[start:]
        for i in range(LANES):
            each = np.int32(first - picked + start + i)
            twig = child_key(key, CHILD + int(each))
            u, _ = two(twig)
            turn = level + slope * np.float32(each) + rotate_v * (_TWO * u - _ONE)
            place = low + (np.float32(each) - made) * step
            back = (high - place) * long
            to[PLACE + i], to[SPIN + i] = place, -turn if each & aside else turn
            to[PX + i], to[PY + i], to[PZ + i] = x - back * dx, y - back * dy, z - back * dz
            to[PDX + i], to[PDY + i], to[PDZ + i] = dx, dy, dz
            to[PAX + i], to[PAY + i], to[PAZ + i] = ax, ay, az
            whose[i], keys[i] = s, twig


@njit(**INNER)
def _turn_on(block, picked, work, owners):
    """Turn each child on from the one before on its stem."""
    i = 0
    while i < picked:
        s = owners[i]
        turn = block[TURN + s]
        while i < picked and owners[i] == s:
            turn += work[SPIN + i]
            work[SPIN + i] = turn
            i += 1
        block[TURN + s] = turn - np.float32(int(turn))
