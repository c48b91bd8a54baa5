"""Leaves of WeberPennGen: where the picks say, as children with a size (sec. 4.6 and 4.9), for a block of picks."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.weberpenn.children import down_angle
from generators.weberpenn.picks import FREE, PAX, PAY, PAZ, PDX, PDY, PDZ, PLACE, PX, ROW, SPIN
from generators.weberpenn.turning import about_vertical, attracted, placed, upper_side
from treefit.plant.compiling import INNER
from treefit.plant.streams import child_key, circle, two

AXIS, NORMAL, SIZE = (FREE + ROW * row for row in (0, 3, 6))
"""Rows of the picks' numbers: of a plant's leaves, in their order; their positions are PX, PY, PZ."""
WORK = FREE + 8 * ROW
_ZERO, _ONE, _TINY = np.float32(0.0), np.float32(1.0), np.float32(1e-6)


@njit(**INNER)
def put_leaves(rule, tree, picked, work, twigs, leaves, k):
    """Put the picked leaves of a block behind the first `k`; return (leaves, whether there was no room for all)."""
    fitting = min(picked, leaves.shape[1] - k)
    _place(rule, tree, work, twigs, fitting)
    if tree.leaf_bend > 0:
        _bend(np.float32(tree.leaf_bend), work, fitting)
    for row in range(len(leaves)):
        first = PX + ROW * row if row < 3 else AXIS + ROW * (row - 3)
        source = work[first : first + fitting]
        target = leaves[row, k : k + fitting]
        for i in range(fitting):
            target[i] = source[i]
    return k + fitting, fitting < picked


@njit(**INNER)
def _place(rule, tree, work, twigs, count):
    """Axis, normal and size of the leaves; the upper side looks to the sky."""
    fan = rule.children < 0
    length, width = np.float32(tree.leaf_length), np.float32(tree.leaf_width)
    for i in range(count):
        u, _ = two(child_key(twigs[i], 0))
        c, w = circle(down_angle(rule, work[PLACE + i], u))
        p, q = circle(work[SPIN + i])
        dx, dy, dz, ax, ay, az = placed(
            work[PDX + i], work[PDY + i], work[PDZ + i], work[PAX + i], work[PAY + i], work[PAZ + i], p, q, c, w, fan
        )  # fmt: skip
        nx, ny, nz = upper_side(dx, dy, dz, ax, ay, az)
        up = math.copysign(_ONE, nz)
        work[AXIS + i], work[AXIS + ROW + i], work[AXIS + 2 * ROW + i] = dx, dy, dz
        work[NORMAL + i], work[NORMAL + ROW + i], work[NORMAL + 2 * ROW + i] = up * nx, up * ny, up * nz
        work[SIZE + i], work[SIZE + ROW + i] = length, width


@njit(**INNER)
def _bend(bend, work, count):
    """Turn the leaves to the light: normals by a share outwards from the trunk, then by the same share upwards.

    Shares are of the chord, not of the angle (sec. 4.9 has the angle): nothing but square roots.
    """
    for i in range(count):
        nx, ny, nz = work[NORMAL + i], work[NORMAL + ROW + i], work[NORMAL + 2 * ROW + i]
        dx, dy, dz = work[AXIS + i], work[AXIS + ROW + i], work[AXIS + 2 * ROW + i]
        ox, oy = work[PX + i], work[PX + ROW + i]
        scale = bend / (math.sqrt((nx * nx + ny * ny) * (ox * ox + oy * oy)) + _TINY)
        c, s = _shared(bend, (nx * ox + ny * oy) * scale, (nx * oy - ny * ox) * scale)
        nx, ny, nz = about_vertical(nx, ny, nz, c, s)
        dx, dy, dz = about_vertical(dx, dy, dz, c, s)
        c, s = _shared(bend, bend * nz, bend * math.sqrt(nx * nx + ny * ny))
        nx, ny, nz, dx, dy, dz = attracted(nx, ny, nz, dx, dy, dz, c, s)
        work[AXIS + i], work[AXIS + ROW + i], work[AXIS + 2 * ROW + i] = dx, dy, dz
        work[NORMAL + i], work[NORMAL + ROW + i], work[NORMAL + 2 * ROW + i] = nx, ny, nz


@njit(**INNER)
def _shared(share, cosine, sine):
    """Cosine and sine of about `share` of an angle whose own, times `share`, are given."""
    c = _ONE - share + cosine
    length = math.sqrt(c * c + sine * sine) + _TINY
    return c / length, sine / length
