"""The light: a grid of voxels around the tree, each with the shade that leaves above cast in pyramids below them.

Palubicki et al. 2009 add a pyramid below every bud. All of them are added here layer by layer: the shade of a layer is
that of the layer above with the leaves there, spread to its neighbours and faded. It is the same sum, for the whole
tree at once, and a pyramid that reaches the ground.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.gegen.tree import X, Y, Z
from treefit.plant.compiling import INNER

CELLS = 20
"""Voxels to the height of the tree."""
WIDE, HIGH = 44, 28
"""Voxels of the grid in either horizontal direction, the tree in the middle, and upwards from the ground."""

BESIDE = 6
"""Voxels beside the tree that its shade may reach."""

FADE = np.float32(0.9)
"""Share of the shade that reaches the next layer below."""
SPREAD = np.float32(0.5)
"""Variance in voxels that it gains there: a pyramid as wide as it is high."""

_ZERO, _ONE, _HALF = np.float32(0.0), np.float32(1.0), np.float32(0.5)
_MIDDLE = np.float32(WIDE / 2)


@njit(**INNER)
def taps(slope):
    """Weights of the three neighbours above from which a voxel gets its shade, for light that comes at a slope."""
    second = SPREAD + slope * slope
    return (second + slope) * _HALF, _ONE - second, (second - slope) * _HALF


@njit(**INNER)
def enclose(joint, n, scale, box):
    """Widen `box` (first and last voxel by x and y, last layer) to hold the joints and the shade beside them."""
    low_x = high_x = low_y = high_y = high = _ZERO
    for i in range(n):
        x, y, z = joint[i, X], joint[i, Y], joint[i, Z]
        low_x, high_x, low_y, high_y = min(low_x, x), max(high_x, x), min(low_y, y), max(high_y, y)
        high = max(high, z)
    middle, far = WIDE // 2, WIDE - 1
    box[0] = min(box[0], max(int(low_x * scale) + middle - BESIDE, 1))
    box[1] = max(box[1], min(int(high_x * scale) + middle + BESIDE, far))
    box[2] = min(box[2], max(int(low_y * scale) + middle - BESIDE, 1))
    box[3] = max(box[3], min(int(high_y * scale) + middle + BESIDE, far))
    box[4] = max(box[4], min(int(high * scale) + 2, HIGH - 1))


@njit(**INNER)
def propagate(source, shade, rows, box, slope_x, slope_y):
    """Fill the box of `shade` (HIGH, WIDE, WIDE) from what is in `source`; nothing is outside the box."""
    xa, xb, xc = taps(slope_x)
    ya, yb, yc = taps(slope_y)
    ya, yb, yc = ya * FADE, yb * FADE, yc * FADE
    x0, x1, y0, y1, top = box[0], box[1], box[2], box[3], box[4]
    width = x1 - x0
    for z in range(top - 1, -1, -1):
        for y in range(y0 - 1, y1 + 1):
            line, own, row = shade[z + 1, y, x0:x1], source[z + 1, y, x0:x1], rows[y]
            for x in range(width):
                row[x + 1] = line[x] + own[x]
            row[0] = row[width + 1] = _ZERO
            middle = rows[WIDE + y]
            for x in range(width):
                middle[x] = xa * row[x + 2] + xb * row[x + 1] + xc * row[x]
        for y in range(y0, y1):
            below = shade[z, y, x0:x1]
            one, two, three = rows[WIDE + y + 1], rows[WIDE + y], rows[WIDE + y - 1]
            for x in range(width):
                below[x] = ya * one[x] + yb * two[x] + yc * three[x]


@njit(**INNER)
def cast(source, x, y, z, scale, amount):
    """Add `amount` of shade to the four voxels around a point in its layer."""
    gx, gy, k = x * scale + _MIDDLE - _HALF, y * scale + _MIDDLE - _HALF, np.int32(z * scale)
    i, j = np.int32(gx), np.int32(gy)
    if gx < _ONE or gy < _ONE or i >= WIDE - 2 or j >= WIDE - 2 or k >= HIGH - 1:
        return
    fx, fy = gx - np.float32(i), gy - np.float32(j)
    low, high = amount * (_ONE - fy), amount * fy
    source[k, j, i] += low * (_ONE - fx)
    source[k, j, i + 1] += low * fx
    source[k, j + 1, i] += high * (_ONE - fx)
    source[k, j + 1, i + 1] += high * fx


@njit(**INNER)
def dark_at(shade, x, y, z, scale):
    """1 + shade of the voxel of a point; 1 outside the grid."""
    i, j, k = np.int32(x * scale + _MIDDLE), np.int32(y * scale + _MIDDLE), np.int32(max(z * scale, _ZERO))
    if i < 0 or j < 0 or i >= WIDE or j >= WIDE or k >= HIGH:
        return _ONE
    return _ONE + shade[k, j, i]


@njit(**INNER)
def light_at(shade, x, y, z, scale):
    """Light at a point, in [0, 1]: 1 / (1 + shade)^2; full outside the grid."""
    gx, gy, gz = x * scale + _MIDDLE - _HALF, y * scale + _MIDDLE - _HALF, z * scale - _HALF
    gz = max(gz, _ZERO)
    i, j, k = np.int32(gx), np.int32(gy), np.int32(gz)
    if gx < _ZERO or gy < _ZERO or i >= WIDE - 1 or j >= WIDE - 1 or k >= HIGH - 1:
        return _ONE
    fx, fy, fz = gx - np.float32(i), gy - np.float32(j), gz - np.float32(k)
    ax, ay = _ONE - fx, _ONE - fy
    low, high = shade[k], shade[k + 1]
    under = ay * (ax * low[j, i] + fx * low[j, i + 1]) + fy * (ax * low[j + 1, i] + fx * low[j + 1, i + 1])
    over = ay * (ax * high[j, i] + fx * high[j, i + 1]) + fy * (ax * high[j + 1, i] + fx * high[j + 1, i + 1])
    dark = _ONE + under + fz * (over - under)
    return _ONE / (dark * dark)
