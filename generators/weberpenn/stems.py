"""Stems of one level, in blocks: all grow segment by segment together, in loops that vector instructions can run.

A stem is a column of a block; a clone, which a split makes, is a column of its own that begins later.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.weberpenn.rules import SEGMENT
from generators.weberpenn.turning import arccos, attracted, pitched, rolled, unit, upper_side
from treefit.plant.compiling import INNER
from treefit.plant.streams import child_key, circle, two

BLOCK = 256  # stems of a block: their numbers stay in the nearest cache
X, Y, Z, DX, DY, DZ, AX, AY, AZ, LONG, THICK, BEGIN, FILL, COUNT, MADE, TURN, BACK, DUE = (
    BLOCK * row for row in range(18)
)
"""Rows of a block's numbers: position of the tip in m; unit direction; unit axis of its bends, to the side; length and
base radius in m; share of the parent where it begins; length by the longest; children it should have, had (from a half
on) and turn of the last; turn that undoes splits, a segment; clones due."""
NOW, BEFORE, PARENT, STEM = (BLOCK * row for row in range(4))
"""Rows of a block's vertices: at the tip, one before, at the parent; and the number of the stem that a clone is of."""
FLOATS, INTS = 18 * BLOCK, 4 * BLOCK
_ZERO, _HALF, _ONE = (np.float32(x) for x in (0.0, 0.5, 1.0))


class Stems(NamedTuple):
    """Blocks of stems: numbers (b, FLOATS), vertices (b, INTS), keys (b, BLOCK)."""

    numbers: NDArray[np.float32]
    vertices: NDArray[np.int32]
    keys: NDArray[np.uint32]


@njit(**INNER)
def frame_of(block, s):
    """Direction of a stem and the axis of its bends."""
    return block[DX + s], block[DY + s], block[DZ + s], block[AX + s], block[AY + s], block[AZ + s]


@njit(**INNER)
def put_frame(block, s, dx, dy, dz, ax, ay, az):
    """Set them."""
    block[DX + s], block[DY + s], block[DZ + s] = dx, dy, dz
    block[AX + s], block[AY + s], block[AZ + s] = ax, ay, az


@njit(**INNER)
def advance(rule, level, segment, step, begins, attraction, block, keys, count):
    """Move the tips of a block by the share `step` of their length; they turn where a segment but the first begins."""
    if begins and rule.helix:
        _wind(np.float32(rule.curve_v), segment == 1, block, count)
    if begins and segment > 1:
        _bend(rule, segment, block, keys, count)
        if level >= 2 and attraction != 0:
            _attract(np.float32(attraction / rule.segments), block, count)
    for s in range(count):
        long = step * block[LONG + s]
        block[X + s] += long * block[DX + s]
        block[Y + s] += long * block[DY + s]
        block[Z + s] = max(block[Z + s] + long * block[DZ + s], _ZERO)


@njit(**INNER)
def _bend(rule, segment, block, keys, count):
    """Bend the block for its next segment (sec. 4.1): about the axis to the side, and sideways."""
    curve = np.float32(rule.curve if 2 * segment <= rule.segments + 1 else rule.curve_back)
    spread, aside = np.float32(0.0 if rule.helix else 2.0 * rule.curve_v), np.float32(2.0 * rule.bend_v)
    for s in range(count):
        u, v = two(child_key(keys[s], SEGMENT + segment))
        c, w = circle(curve + block[BACK + s] + spread * (u - _HALF))
        p, q = circle(aside * (v - _HALF))
        put_frame(block, s, *pitched(*frame_of(block, s), c, w, p, q))


@njit(**INNER)
def _wind(cone, first, block, count):
    """Turn the block a quarter around the axes of helices, cones open by `cone` turns; at `first` lean out on them."""
    c, w = circle(cone)
    for s in range(count):
        dx, dy, dz, ax, ay, az = frame_of(block, s)
        ux, uy, uz = upper_side(dx, dy, dz, ax, ay, az)
        if first:
            put_frame(block, s, c * dx - w * ux, c * dy - w * uy, c * dz - w * uz, ax, ay, az)
            continue
        kx, ky, kz = unit(c * dx + w * ux, c * dy + w * uy, c * dz + w * uz)  # the axis of the helix
        put_frame(block, s, *rolled(dx, dy, dz, kx, ky, kz), *rolled(ax, ay, az, kx, ky, kz))


@njit(**INNER)
def _attract(attraction, block, count):
    """Turn the block to the sky by `attraction` of the angle to it, at negative ones to the ground (sec. 4.8)."""
    share, turn = min(attraction, _ONE), np.float32(0.5 / math.pi)
    for s in range(count):
        declination = turn * arccos(block[DZ + s])
        c, w = circle(max(share * declination, declination - _HALF))
        put_frame(block, s, *attracted(*frame_of(block, s), c, w))
