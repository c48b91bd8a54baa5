"""Neighbours: the foliage that stands around the tree, and the shade of all that does not change while it grows."""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.gegen.field import CELLS, HIGH, WIDE, propagate
from treefit.plant.compiling import INNER, ONCE

DENSITY = np.float32(0.5)
"""Shade that a voxel full of a neighbour's foliage adds."""
_ZERO, _ONE = np.float32(0.0), np.float32(1.0)
_MIDDLE = np.float32(WIDE / 2)


@njit(**INNER)
def shade_of_scenery(rule, scenery, source, own, still, total, rows, box):
    """Fill `still` and `total` with the shade of `scenery` and the neighbours; return whether there is any.

    All are (HIGH, WIDE, WIDE); `scenery`, or empty, is what every voxel of the surroundings adds. Shade adds up, so
    that this is done once a tree and not once a year. `own` is empty, `source` is left empty.
    """
    if scenery.shape[0] == 0 and max(rule.neighbour_left, rule.neighbour_right) <= 0:
        return False
    source[:] = _ZERO
    box[0] = box[2] = 1
    box[1] = box[3] = WIDE - 1
    box[4] = HIGH - 1
    if scenery.shape[0] > 0:
        add_still(source, source, scenery, box)
    top = _add_neighbours(rule, source, rows[0])
    if scenery.shape[0] == 0:
        box[4] = top
    still[box[4] :] = _ZERO
    total[box[4] :] = _ZERO
    propagate(source, still, rows, box, np.float32(rule.light_x), np.float32(rule.light_y))
    add_still(total, own, still, box)
    source[:] = _ZERO
    return True


@njit(**ONCE)
def _add_neighbours(rule, source, beyond):
    """Add the foliage that stands beyond the gap; return the layer above it.

    In front and behind it is as high as the lower side, so that a tree between two is in a gap of the forest.
    """
    cells = np.float32(CELLS)
    left, right = np.float32(rule.neighbour_left) * cells, np.float32(rule.neighbour_right) * cells
    depth, gap = min(left, right), np.float32(rule.gap) * cells
    top = min(int(max(left, right)) + 2, HIGH - 1)
    for i in range(WIDE):
        beyond[i] = _beyond(i, gap)
    for z in range(top):
        floor = np.float32(z)
        to_left, to_right = DENSITY * _covered(left - floor), DENSITY * _covered(right - floor)
        to_depth = DENSITY * _covered(depth - floor)
        for y in range(WIDE):
            far, row = to_depth * beyond[y], source[z, y]
            for x in range(WIDE // 2):
                row[x] += max(far, to_left * beyond[x])
            for x in range(WIDE // 2, WIDE):
                row[x] += max(far, to_right * beyond[x])
    return top


@njit(**INNER)
def _beyond(voxel, gap):
    """Share of a voxel that is further from the middle than `gap`."""
    inner = np.float32(voxel) - _MIDDLE if voxel >= WIDE // 2 else _MIDDLE - np.float32(voxel + 1)
    return _ONE - _covered(gap - inner)


@njit(**INNER)
def _covered(length):
    """`length` in [0, 1]."""
    return min(max(length, _ZERO), _ONE)


@njit(**INNER)
def add_still(total, own, still, box):
    """Fill the box of `total` with the tree's own shade and that of its surroundings."""
    for z in range(box[4] + 1):
        for y in range(box[2], box[3]):
            for x in range(box[0], box[1]):
                total[z, y, x] = own[z, y, x] + still[z, y, x]
