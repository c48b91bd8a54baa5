"""Weld: corners at the same place become one, so that seams of textures and loose triangles join."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

NEAR = 2e-6
"""Distance at which two corners are one, in extents of the tree: ten times what single precision tells apart."""

_CELL = 16.0  # cells of the search are so many such distances wide: few corners have more than one to look into


def weld(places: NDArray[np.float64], extent: float) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return the different places (n, 3) among `places` (v, 3), and for each of those (v,) which one it is."""
    joined, label = _weld(places, NEAR * extent)
    return joined, label


@njit(cache=True, nogil=True)
def _weld(places, near):
    count = places.shape[0]
    size = 64
    while size < 2 * count:
        size *= 2
    head, after = np.full(size, -1, np.int32), np.empty(count, np.int32)
    label, first, found = np.empty(count, np.int32), np.empty(count, np.int32), 0
    cell, mask = _CELL * near, size - 1
    low = np.empty(3, np.int64)
    high = np.empty(3, np.int64)
    for i in range(count):
        for axis in range(3):
            low[axis] = np.int64(np.floor((places[i, axis] - near) / cell))
            high[axis] = np.int64(np.floor((places[i, axis] + near) / cell))
        same = -1
        for x in range(low[0], high[0] + 1):
            for y in range(low[1], high[1] + 1):
                for z in range(low[2], high[2] + 1):
                    j = head[_bucket(x, y, z, mask)]
                    while j >= 0 and same < 0:
                        if (
                            abs(places[j, 0] - places[i, 0]) <= near
                            and abs(places[j, 1] - places[i, 1]) <= near
                            and abs(places[j, 2] - places[i, 2]) <= near
                        ):
                            same = j
                        j = after[j]
        if same >= 0:
            label[i] = label[same]
            continue
        label[i], first[found] = found, i
        found += 1
        for axis in range(3):
            low[axis] = np.int64(np.floor(places[i, axis] / cell))
        at = _bucket(low[0], low[1], low[2], mask)
        after[i], head[at] = head[at], i
    return places[first[:found]], label


@njit(inline="always")
def _bucket(x, y, z, mask):
    return ((x * 73856093) ^ (y * 19349663) ^ (z * 83492791)) & mask
