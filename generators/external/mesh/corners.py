"""Corners: which triangles meet at each place of a mesh, and what hangs together."""

from __future__ import annotations

import numpy as np
from numba import njit


@njit(cache=True, nogil=True)
def corners_of(triangles, count):
    """Triangles at each place as a list: `first` (n + 1,), `around` (3 t,)."""
    first = np.zeros(count + 1, np.int32)
    for t in range(triangles.shape[0]):
        for k in range(3):
            first[triangles[t, k] + 1] += 1
    for i in range(count):
        first[i + 1] += first[i]
    filled, around = first[:-1].copy(), np.empty(3 * triangles.shape[0], np.int32)
    for t in range(triangles.shape[0]):
        for k in range(3):
            i = triangles[t, k]
            around[filled[i]] = t
            filled[i] += 1
    return first, around


@njit(cache=True, nogil=True)
def root_of(above, i):
    """Representative of the set of `i`; shortens the way for the next time."""
    while above[i] != i:
        above[i] = above[above[i]]
        i = above[i]
    return i


@njit(inline="always")
def square(a, b):
    """Square of the distance between two places (3,)."""
    return (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2
