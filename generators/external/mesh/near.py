"""Near: the segments of wood around a place, found by cells of a grid."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Grid: TypeAlias = tuple[Ints, Ints, float]  # first segment of each bucket, segments, width of a cell

MOST = 4096  # segments of a bucket that are looked at: a flood costs no more than the wood it is
_WIDE = 8  # cells around a sample in which a thick segment is listed, at most


def grid_of(centre: Floats, radius: Floats, parent: Ints, cell: float) -> Grid:
    """Grid of the segments from each ring to its parent; thick ones are in all cells that they fill."""
    size = 1 << max(int(4 * len(centre)).bit_length(), 6)
    first = np.zeros(size + 1, np.int32)
    _list(centre, radius, parent, cell, first, np.empty(0, np.int32), False)
    np.cumsum(first, out=first)
    items = np.empty(first[-1], np.int32)
    filled = np.concatenate([first[:-1], first[-1:]])
    _list(centre, radius, parent, cell, filled, items, True)
    return first, items, cell


@njit(cache=True, nogil=True)
def _list(centre, radius, parent, cell, at, items, fill):
    """Count the segments of each bucket in `at` (one place behind), or, with `fill`, write them from there on."""
    mask = at.shape[0] - 2
    for i in range(centre.shape[0]):
        p = parent[i]
        if p < 0:
            continue
        length = np.sqrt(((centre[i] - centre[p]) ** 2).sum())
        steps = min(int(length / cell) + 1, 100_000)
        thick = max(radius[i], radius[p])
        reach = min(int(np.ceil(thick / cell - 0.5)), _WIDE) if thick > 0.5 * cell else 0
        lx, ly, lz = 1 << 40, 0, 0
        for s in range(steps + 1):
            share = s / steps
            x = int(np.floor((centre[p, 0] + share * (centre[i, 0] - centre[p, 0])) / cell))
            y = int(np.floor((centre[p, 1] + share * (centre[i, 1] - centre[p, 1])) / cell))
            z = int(np.floor((centre[p, 2] + share * (centre[i, 2] - centre[p, 2])) / cell))
            if x == lx and y == ly and z == lz:
                continue
            lx, ly, lz = x, y, z
            for dx in range(-reach, reach + 1):
                for dy in range(-reach, reach + 1):
                    for dz in range(-reach, reach + 1):
                        b = bucket(x + dx, y + dy, z + dz, mask)
                        if fill:
                            items[at[b]] = i
                            at[b] += 1
                        else:
                            at[b + 1] += 1


@njit(inline="always")
def cell_of(place, cell):
    """Cell of a place (3,)."""
    return int(np.floor(place[0] / cell)), int(np.floor(place[1] / cell)), int(np.floor(place[2] / cell))


@njit(inline="always")
def bucket(x, y, z, mask):
    """Bucket of a cell."""
    return ((x * 73856093) ^ (y * 19349663) ^ (z * 83492791)) & mask


@njit(cache=True, nogil=True)
def to_segment(place, begin, end):
    """Share of the way from `begin` to `end` that is nearest to a place (3,), and the distance there."""
    along = to_place = 0.0
    for axis in range(3):
        step = end[axis] - begin[axis]
        along += step * step
        to_place += step * (place[axis] - begin[axis])
    share = min(max(to_place / max(along, 1e-30), 0.0), 1.0)
    far = 0.0
    for axis in range(3):
        far += (place[axis] - begin[axis] - share * (end[axis] - begin[axis])) ** 2
    return share, np.sqrt(far)


@njit(cache=True, nogil=True)
def nearest(places, centre, parent, first, items, cell, found):
    """Write the place of the wood nearest to each of `places` (k, 3) into `found` (k, 3), where that is NaN.

    It stays NaN where no wood is within a cell.
    """
    mask = first.shape[0] - 2
    for i in range(places.shape[0]):
        if found[i, 0] == found[i, 0]:
            continue
        x, y, z = cell_of(places[i], cell)
        least = np.inf
        for n in range(13, 40):  # the middle one of the 27 cells comes first, so that most others are too far
            dx, dy, dz = n % 3 - 1, n // 3 % 3 - 1, n // 9 % 3 - 1
            if _to_cell(places[i], x + dx, y + dy, z + dz, cell) >= least:
                continue
            b = bucket(x + dx, y + dy, z + dz, mask)
            for e in range(first[b], min(first[b + 1], first[b] + MOST)):
                j = items[e]
                share, far = to_segment(places[i], centre[parent[j]], centre[j])
                if far < least:
                    least = far
                    for axis in range(3):
                        a = centre[parent[j], axis]
                        found[i, axis] = a + share * (centre[j, axis] - a)


@njit(inline="always")
def _to_cell(place, x, y, z, cell):
    """Distance of a place to a cell."""
    dx = max(x * cell - place[0], place[0] - (x + 1) * cell, 0.0)
    dy = max(y * cell - place[1], place[1] - (y + 1) * cell, 0.0)
    dz = max(z * cell - place[2], place[2] - (z + 1) * cell, 0.0)
    return np.sqrt(dx * dx + dy * dy + dz * dz)
