"""Soles: where closed pieces of wood begin: a level set seen from the far end, or of short ones the best tip or cap."""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.external.mesh.corners import corners_of

_ACROSS = 0.7  # cosine between the axis and the normals of a cap, at least


@njit(cache=True, nogil=True)
def rims(triangles, level, ends, source):
    """Mark in `source` (n,) the places that hang together with each of the `ends` and are of the same level (n,)."""
    first, around = corners_of(triangles, level.shape[0])
    open_ = np.empty(level.shape[0], np.int32)
    for end in ends:
        source[end], open_[0], waiting = 1, end, 1
        while waiting > 0:
            waiting -= 1
            i = open_[waiting]
            for e in range(first[i], first[i + 1]):
                for k in range(3):
                    j = triangles[around[e], k]
                    if level[j] == level[end] and source[j] == 0:
                        source[j], open_[waiting] = 1, j
                        waiting += 1


@njit(cache=True, nogil=True)
def soles(places, triangles, ends, others, source):
    """Mark in `source` (n,) what the short pieces between `ends` and `others` begin with.

    Tried are both ends, each place beside them, which a tip may be, and the rim of the cap at each. That one is taken
    from which the level sets are narrowest: it gives rings, and not slices aslant.
    """
    count = places.shape[0]
    first, around = corners_of(triangles, count)
    steps, open_, chosen = np.full(count, -1, np.int32), np.empty(count, np.int32), np.empty(count, np.int32)
    tried = np.empty(count, np.int32)
    for n in range(ends.shape[0]):
        axis = places[others[n]] - places[ends[n]]
        axis /= max(np.sqrt((axis**2).sum()), 1e-30)
        best, size = np.inf, 0
        for end in (ends[n], others[n]):
            for e in range(first[end] - 1, first[end + 1]):
                for k in range(3):
                    if e >= first[end]:  # a place beside the end, or the end itself
                        tried[0], found = triangles[around[e], k], 1
                    else:
                        found = _rim(places, triangles, first, around, end, axis, steps, open_, tried)
                    spread = _spread(places, triangles, first, around, tried[:found], steps, open_)
                    if spread < 0.999 * best:
                        best, size = spread, found
                        chosen[:found] = tried[:found]
        for m in range(size):
            source[chosen[m]] = 1


@njit(cache=True, nogil=True)
def _rim(places, triangles, first, around, end, axis, seen, open_, rim):
    """Count of the places listed in `rim`: around the triangles at an end that lie across the axis."""
    seen[end], open_[0], at, found, size = 1, end, 0, 1, 0
    while at < found:
        i = open_[at]
        at += 1
        border = False
        for e in range(first[i], first[i + 1]):
            if abs((_normal(places, triangles[around[e]]) * axis).sum()) < _ACROSS:
                border = True
                continue
            for k in range(3):
                j = triangles[around[e], k]
                if seen[j] < 0:
                    seen[j], open_[found] = 1, j
                    found += 1
        if border:
            rim[size] = i
            size += 1
    for n in range(found):
        seen[open_[n]] = -1
    if size == 0:
        rim[0], size = end, 1
    return size


@njit(cache=True, nogil=True)
def _spread(places, triangles, first, around, sources, steps, open_):
    """Sum of the squares of the distances of all places of a piece to the middle of their level set."""
    found, at, spread = 0, 0, 0.0
    for i in sources:
        steps[i], open_[found] = 0, i
        found += 1
    begin, x, y, z, square = 0, 0.0, 0.0, 0.0, 0.0
    origin = places[sources[0]]
    while at < found:
        i = open_[at]
        if steps[i] != steps[open_[begin]]:
            spread += square - (x * x + y * y + z * z) / (at - begin)
            begin, x, y, z, square = at, 0.0, 0.0, 0.0, 0.0
        dx, dy, dz = places[i, 0] - origin[0], places[i, 1] - origin[1], places[i, 2] - origin[2]
        x, y, z, square = x + dx, y + dy, z + dz, square + dx * dx + dy * dy + dz * dz
        at += 1
        for e in range(first[i], first[i + 1]):
            for k in range(3):
                j = triangles[around[e], k]
                if steps[j] < 0:
                    steps[j], open_[found] = steps[i] + 1, j
                    found += 1
    for n in range(found):
        steps[open_[n]] = -1
    return spread + square - (x * x + y * y + z * z) / (found - begin)


@njit(cache=True, nogil=True)
def _normal(places, triangle):
    """Unit normal (3,) of a triangle."""
    a, b, c = places[triangle[0]], places[triangle[1]], places[triangle[2]]
    x = (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1])
    y = (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2])
    z = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return np.array([x, y, z]) / max(np.sqrt(x * x + y * y + z * z), 1e-30)
