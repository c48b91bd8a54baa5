"""Bumps: level sets that are no rings of a stem, but a bump of its bark or the flat cap of its end."""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.external.mesh.corners import square

_CAP = 0.1  # of the radius: what ends so near behind a ring is the middle of its cap


@njit(cache=True, nogil=True)
def worthy(centre, radius, parent, loose):
    """Whether each ring (m,) is one of a stem. A piece that begins with the middle of a cap begins behind it instead.

    Of the ways on from a ring the longest is the stem; others are bumps when they end within its radius, or begin with
    a `loose` ring (m,).
    """
    count = radius.shape[0]
    kept, step, reach = np.ones(count, np.bool_), np.zeros(count), np.zeros(count)
    children, longest = np.zeros(count, np.int32), np.full(count, -1, np.int32)
    for r in range(count - 1, -1, -1):
        p = parent[r]
        if p < 0:
            continue
        step[r] = np.sqrt(square(centre[r], centre[p]))
        children[p] += 1
        if longest[p] < 0 or reach[r] + step[r] > reach[p]:
            longest[p], reach[p] = r, reach[r] + step[r]
    for r in range(count):
        p = parent[r]
        if p < 0:
            continue
        bump = longest[p] != r and (loose[r] or reach[r] + step[r] < radius[p])
        cap = children[r] == 0 and parent[p] >= 0 and step[r] < _CAP * radius[p]
        kept[r] = kept[p] and not bump and not cap
    for r in range(count):
        p = parent[r]
        alone = p >= 0 and parent[p] < 0 and children[p] == 1 and kept[r]
        if alone and radius[p] < 0.5 * radius[r] and step[r] < 0.5 * radius[r]:
            kept[p], parent[r] = False, -1
    return kept
