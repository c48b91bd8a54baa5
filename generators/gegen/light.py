"""Light: what the leaves leave of it, its sums over buds from tip to base, and what is shed for want of it.

Palubicki et al. 2009, sec. 4.2 and 4.3.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.gegen.field import cast, enclose, light_at, propagate
from generators.gegen.tree import (
    AGED,
    AXIS,
    BASE,
    BORN,
    BUDS,
    DEAD,
    FIRST,
    GATHERED,
    LAST,
    LATERALS,
    MAIN,
    PARENT,
    SIDE,
    SIZE,
    START,
    TIP,
    WEIGHT,
    X,
    Y,
    Z,
)  # fmt: skip
from treefit.plant.compiling import ONCE
from treefit.plant.streams import uniform

SHARPNESS = 4
"""Power of the light a joint by its threshold that is the odds of a branch to stay."""
YOUNG = 2
"""Years in which a branch is not given up."""
SHED = 1
"""Purpose of the draw of an axis that decides whether it is shed."""
_ZERO, _ONE = np.float32(0.0), np.float32(1.0)


@njit(**ONCE)
def cast_shade(rule, tree, n, scale, source, shade, row, box):
    """Fill `shade` with that of the leaves of the first `n` joints."""
    joint, node, _, stem, _ = tree
    enclose(joint, n, scale, box)
    for z in range(box[4] + 1):
        for y in range(box[2] - 1, box[3] + 1):
            for x in range(box[0] - 1, box[1] + 1):
                source[z, y, x] = _ZERO
    amount = np.float32(rule.shade) * scale * scale
    for i in range(1, n):
        if not stem[DEAD, node[AXIS, i]] and stem[LAST, node[AXIS, i]] - node[BORN, i] < rule.leaf_years:
            cast(source, joint[X, i], joint[Y, i], joint[Z, i], scale, amount)
    propagate(source, shade, row, box, np.float32(rule.light_x), np.float32(rule.light_y))


@njit(**ONCE)
def gather(rule, tree, axes, shade, scale, year):
    """Sum the light of buds over every axis and over what is to the side of its joints; shed branches."""
    joint, node, axis, stem, key = tree
    for a in range(axes - 1, -1, -1):
        axis[GATHERED, a] = axis[SIZE, a] = _ZERO
        if stem[DEAD, a]:
            continue
        j, base = stem[TIP, a], stem[BASE, a]
        main, size = _ZERO, _ZERO
        if not stem[AGED, a]:
            main = light_at(shade, joint[X, j], joint[Y, j], joint[Z, j], scale)
            joint[SIDE, j] = _ZERO
            joint[MAIN, j] = main
            size += _ONE
            j = node[PARENT, j]
        while j != base:
            side = _ZERO
            if node[LATERALS, j] > 0:
                for lateral in range(node[FIRST, j], node[FIRST, j] + node[LATERALS, j]):
                    side += axis[GATHERED, lateral]
                    size += axis[SIZE, lateral]
            elif node[BUDS, j] > 0:
                if year - node[BORN, j] > rule.bud_life:
                    node[BUDS, j] = 0
                else:
                    light = light_at(shade, joint[X, j], joint[Y, j], joint[Z, j], scale)
                    side = light * joint[WEIGHT, j] * np.float32(node[BUDS, j])
            joint[MAIN, j], joint[SIDE, j] = main, side
            main += side
            size += _ONE
            j = node[PARENT, j]
        if a > 0 and year - stem[START, a] >= YOUNG and _given_up(rule, main, size, key[a]):
            stem[DEAD, a] = 1
            continue
        axis[GATHERED, a], axis[SIZE, a] = main, size


@njit(**ONCE)
def _given_up(rule, light, size, key):
    """Whether a branch lives beyond its means: its odds to stay are a power of its light a joint."""
    if rule.shedding <= 0:
        return False
    odds = (light / (size * np.float32(rule.shedding))) ** SHARPNESS
    return uniform(key, SHED) * (_ONE + odds) < _ONE
