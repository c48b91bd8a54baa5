"""Girth: centre and radius of the rings of wood."""

from __future__ import annotations

import numpy as np
from numba import njit


@njit(cache=True, nogil=True)
def measured(places, weight, first, members, parent):
    """Centre (m, 3) and radius (m,) of rings, whose places are listed as `first`, `members`; weights (n,) of places.

    The radius is the mean distance from the axis, less by what a regular polygon is narrower than its circle.
    """
    count = parent.shape[0]
    centre, total, child = np.zeros((count, 3)), np.zeros(count), np.full(count, -1, np.int32)
    for r in range(count):
        for e in range(first[r], first[r + 1]):
            i = members[e]
            total[r] += weight[i]
            for axis in range(3):
                centre[r, axis] += weight[i] * places[i, axis]
        for axis in range(3):
            centre[r, axis] /= total[r]
        p = parent[r]  # of several rings behind it the largest gives it its axis
        if p >= 0 and (child[p] < 0 or first[r + 1] - first[r] > first[child[p] + 1] - first[child[p]]):
            child[p] = r
    radius = np.zeros(count)
    for r in range(count):
        sides = first[r + 1] - first[r]
        if sides < 2:
            continue
        ahead, behind = child[r] if child[r] >= 0 else r, parent[r] if parent[r] >= 0 else r
        x, y, z = (centre[ahead, 0] - centre[behind, 0], centre[ahead, 1] - centre[behind, 1],
                   centre[ahead, 2] - centre[behind, 2])  # fmt: skip
        length = max(np.sqrt(x * x + y * y + z * z), 1e-30)
        far = 0.0
        for e in range(first[r], first[r + 1]):
            i = members[e]
            dx, dy, dz = places[i, 0] - centre[r, 0], places[i, 1] - centre[r, 1], places[i, 2] - centre[r, 2]
            along = (dx * x + dy * y + dz * z) / length
            far += weight[i] * np.sqrt(max(dx * dx + dy * dy + dz * dz - along * along, 0.0))
        radius[r] = far / total[r] * np.sin(np.pi / sides) * sides / np.pi
    return centre, radius
