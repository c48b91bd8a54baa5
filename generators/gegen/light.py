"""Light: what the leaves leave of it, its sums over buds from tip to base, and what is shed for want of it.

Palubicki et al. 2009, sec. 4.2 and 4.3.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.gegen.field import cast, enclose, light_at, propagate
from generators.gegen.tree import (
    AGED,
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
def cast_shade(rule, tree, n, axes, scale, source, shade, row, box):
    """Fill `shade` with that of the leaves."""
    joint, node, _, stem, _ = tree
    enclose(joint, n, scale, box)
    for z in range(box[4] + 1):
        for y in range(box[2] - 1, box[3] + 1):
            for x in range(box[0] - 1, box[1] + 1):
                source[z, y, x] = _ZERO
    amount = np.float32(rule.shade) * scale * scale
    for a in range(axes):
        j, base, oldest = stem[a, TIP], max(stem[a, BASE], 0), stem[a, LAST] - rule.leaf_years
        while not stem[a, DEAD] and j != base and node[j, BORN] > oldest:
            cast(source, joint[j, X], joint[j, Y], joint[j, Z], scale, amount)
            j = node[j, PARENT]
    propagate(source, shade, row, box, np.float32(rule.light_x), np.float32(rule.light_y))


@njit(**ONCE)
def gather(rule, tree, axes, shade, scale, year):
    """Sum the light of buds over every axis and over what is to the side of its joints; shed branches."""
    joint, node, axis, stem, key = tree
    for a in range(axes - 1, -1, -1):
        axis[a, GATHERED] = axis[a, SIZE] = _ZERO
        if stem[a, DEAD]:
            continue
        j, base = stem[a, TIP], stem[a, BASE]
        main, size = _ZERO, _ZERO
        if not stem[a, AGED]:
            main = light_at(shade, joint[j, X], joint[j, Y], joint[j, Z], scale)
            joint[j, SIDE] = _ZERO
            joint[j, MAIN] = main
            size += _ONE
            j = node[j, PARENT]
        while j != base:
            side = _ZERO
            if node[j, LATERALS] > 0:
                for lateral in range(node[j, FIRST], node[j, FIRST] + node[j, LATERALS]):
                    side += axis[lateral, GATHERED]
                    size += axis[lateral, SIZE]
            elif node[j, BUDS] > 0:
                if year - node[j, BORN] > rule.bud_life:
                    node[j, BUDS] = 0
                else:
                    light = light_at(shade, joint[j, X], joint[j, Y], joint[j, Z], scale)
                    side = light * joint[j, WEIGHT] * np.float32(node[j, BUDS])
            joint[j, MAIN], joint[j, SIDE] = main, side
            main += side
            size += _ONE
            j = node[j, PARENT]
        if a > 0 and year - stem[a, START] >= YOUNG and _given_up(rule, main, size, key[a]):
            stem[a, DEAD] = 1
            continue
        axis[a, GATHERED], axis[a, SIZE] = main, size


@njit(**ONCE)
def _given_up(rule, light, size, key):
    """Whether a branch lives beyond its means: its odds to stay are a power of its light a joint."""
    if rule.shedding <= 0:
        return False
    odds = (light / (size * np.float32(rule.shedding))) ** SHARPNESS
    return uniform(key, SHED) * (_ONE + odds) < _ONE
