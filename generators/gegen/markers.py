"""Markers of space colonisation (Runions et al. 2007; Palubicki et al. 2009, sec. 4.1): free places that buds grow to.

There is one in every cube of a lattice, at a place drawn for that cube, so that none has to be stored. A joint takes
the markers around it for ever; a bud grows towards the best-lit free marker ahead, and not at all when there is none.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.gegen.field import light_at
from treefit.plant.compiling import INNER
from treefit.plant.streams import child_key

SIDE = 128
"""Cubes of a lattice of one internode in every direction; beyond them it begins again."""
BYTES = SIDE**3 // 8
REACH, TAKEN, AHEAD = np.float32(2.0), np.float32(0.75), np.float32(0.6)
"""Internodes in which a bud sees markers and in which a joint takes them; cosine of half the angle of a bud's sight."""
MARKER = 1
"""Purpose of the draws of all markers."""
_SPAN, _TENTH = np.int64(SIDE - 1), np.uint32(1023)
_TEN, _TWENTY = np.uint32(10), np.uint32(20)
_CUBE = np.float32(1.0 / 1024.0)
_ZERO, _ONE, _TINY = np.float32(0.0), np.float32(1.0), np.float32(1e-9)
_BEHIND = np.float32(-0.9)  # nearest middle of a cube whose corners are all behind


@njit(**INNER)
def cube_of(i, j, k):
    """Number of a cube in the lattice."""
    return (((k & _SPAN) * SIDE + (j & _SPAN)) * SIDE) + (i & _SPAN)


@njit(**INNER)
def marker_at(key, cube, i, j, k):
    """Place of the marker in a cube, in internodes."""
    draw = child_key(key, cube)
    u, v, w = draw & _TENTH, (draw >> _TEN) & _TENTH, (draw >> _TWENTY) & _TENTH
    return (
        np.float32(i) + np.float32(np.int32(u)) * _CUBE, np.float32(j) + np.float32(np.int32(v)) * _CUBE,
        np.float32(k) + np.float32(np.int32(w)) * _CUBE,
    )  # fmt: skip


@njit(**INNER)
def take(taken, key, x, y, z):
    """Take the markers around a joint."""
    i0, j0, k0 = math.floor(x - TAKEN), math.floor(y - TAKEN), math.floor(z - TAKEN)
    i1, j1, k1 = math.floor(x + TAKEN), math.floor(y + TAKEN), math.floor(z + TAKEN)
    for k in range(int(k0), int(k1) + 1):
        for j in range(int(j0), int(j1) + 1):
            for i in range(int(i0), int(i1) + 1):
                cube = cube_of(i, j, k)
                mx, my, mz = marker_at(key, cube, i, j, k)
                mx, my, mz = mx - x, my - y, mz - z
                if mx * mx + my * my + mz * mz < TAKEN * TAKEN:
                    taken[cube >> 3] |= np.uint8(1 << (cube & 7))


@njit(**INNER)
def towards_marker(taken, shade, x, y, z, dx, dy, dz, scale, key):
    """Unit way to the best-lit free marker ahead, 0 when there is none."""
    best, bx, by, bz = -_ONE, _ZERO, _ZERO, _ZERO
    length = math.sqrt(dx * dx + dy * dy + dz * dz) + _TINY
    dx, dy, dz = dx / length, dy / length, dz / length
    i0, j0, k0 = int(math.floor(x)), int(math.floor(y)), int(math.floor(z))
    for k in range(max(k0 - 2, 0), k0 + 3):
        for j in range(j0 - 2, j0 + 3):
            for i in range(i0 - 2, i0 + 3):
                half = np.float32(0.5)
                cx, cy, cz = np.float32(i) + half - x, np.float32(j) + half - y, np.float32(k) + half - z
                if cx * dx + cy * dy + cz * dz < _BEHIND:
                    continue
                cube = cube_of(i, j, k)
                if taken[cube >> 3] >> (cube & 7) & 1:
                    continue
                mx, my, mz = marker_at(key, cube, i, j, k)
                mx, my, mz = mx - x, my - y, mz - z
                far = math.sqrt(mx * mx + my * my + mz * mz)
                if far > REACH or mx * dx + my * dy + mz * dz < AHEAD * far:
                    continue
                light = light_at(shade, mx + x, my + y, mz + z, scale)
                if light > best:
                    inverse = _ONE / (far + _TINY)
                    best, bx, by, bz = light, mx * inverse, my * inverse, mz * inverse
    return bx, by, bz
