"""Rings: room for the rings of all stems of a mesh, and where on them another stem begins."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant.bends import point
from treefit.plant.compiling import INNER

NO_COLLAR = -1.0

Numbers = NDArray[np.float64]


class Rings(NamedTuple):
    """Rings (m,) in order along their stems, filled from the first on."""

    centre: Numbers  # (m, 3) m
    radius: Numbers  # (m,) m
    at: Numbers  # (m,) ring of the chains that it lies at or after, and the share of the way to the next one
    along: Numbers  # (m,) m from where the stem begins
    collar: Numbers  # (m,) 0 on the parent's surface to 1 at the neck, NO_COLLAR elsewhere


@njit(**INNER)
def put(rings, n, begin, old, radius, low, k, t, bend, collar):
    """Put ring n of the stem whose first ring is `begin`: at the share t of the stem's segment k; return n + 1."""
    rings.radius[n] = point(old, radius, low + k, k, bend, t, rings.centre[n])
    rings.at[n] = low + k + t
    rings.collar[n] = collar
    rings.along[n] = 0.0 if n == begin else rings.along[n - 1] + apart(rings.centre[n - 1], rings.centre[n])
    return n + 1


@njit(**INNER)
def place_on(at, ring, old, share):
    """Ring at or before the share of the way from ring `old` of the chains to the next one, and the share from it."""
    j, key = ring[old], old + share
    while at[j + 1] <= key:
        j += 1
    if key <= at[j]:
        return j, 0.0
    return j, (key - at[j]) / (at[j + 1] - at[j])


@njit(**INNER)
def between(rows, j, share, place):
    """Fill `place` (3,) between two rows (m, 3)."""
    for axis in range(3):
        place[axis] = rows[j, axis] + (share * (rows[j + 1, axis] - rows[j, axis]) if share > 0 else 0.0)


@njit(**INNER)
def direction(rings, j, share, unit):
    """Fill the direction (3,) of a stem on its ring j, halfway between those of its segments, or after it."""
    onward = rings.along[j + 1] > rings.along[j] and rings.at[j + 1] < np.inf
    back = rings.along[j] > 0 and share == 0
    for axis in range(3):
        unit[axis] = 0.0
        if onward:
            step = rings.along[j + 1] - rings.along[j]
            unit[axis] += (rings.centre[j + 1, axis] - rings.centre[j, axis]) / step
        if back:
            step = rings.along[j] - rings.along[j - 1]
            unit[axis] += (rings.centre[j, axis] - rings.centre[j - 1, axis]) / step
    norm = np.sqrt(unit[0] ** 2 + unit[1] ** 2 + unit[2] ** 2)
    for axis in range(3):
        unit[axis] /= max(norm, 1e-12)


@njit(**INNER)
def wood_at(rings, j, share, last):
    """Radius of a stem at the share of the way from its ring j on, and its lengths from its begin and to `last`."""
    radius, along = rings.radius[j], rings.along[j]
    if share > 0:
        radius += share * (rings.radius[j + 1] - radius)
        along += share * (rings.along[j + 1] - along)
    return radius, along, rings.along[last] - along


@njit(**INNER)
def apart(one, other):
    """Distance of two points (3,)."""
    return np.sqrt((one[0] - other[0]) ** 2 + (one[1] - other[1]) ** 2 + (one[2] - other[2]) ** 2)
