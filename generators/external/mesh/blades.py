"""Blades: triangles of foliage fall apart into leaves, each a flat connected piece or a single triangle."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.external.mesh.corners import root_of

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

FLAT = 0.7
"""Sum of the area normals by the area above which foliage is one leaf; folded and bent leaves are under 1."""

_BEND = 0.3  # cosine between neighbouring triangles of one leaf, at least


def single_sided(triangles: Ints) -> NDArray[np.bool_]:
    """Whether each triangle (t,) has an area and is the first one with its corners: backs do not count."""
    return np.asarray(_single_sided(triangles))


@njit(cache=True, nogil=True)
def _single_sided(triangles):
    count, size = triangles.shape[0], 64
    while size < 2 * count:
        size *= 2
    table, kept = np.full(size, -1, np.int32), np.zeros(count, np.bool_)
    for t in range(count):
        a, b, c = _sorted(triangles[t])
        if a == b or b == c:
            continue
        at = _bucket(a, b, c, size - 1)
        kept[t] = True
        while table[at] >= 0 and kept[t]:
            x, y, z = _sorted(triangles[table[at]])
            kept[t] = x != a or y != b or z != c
            at = (at + 1) & (size - 1)
        if kept[t]:
            table[at] = t
    return kept


@njit(cache=True, nogil=True)
def normals_of(places, triangles):
    """Area normals (t, 3): of the length of the area."""
    normals = np.empty((triangles.shape[0], 3))
    for t in range(triangles.shape[0]):
        a, b, c = places[triangles[t, 0]], places[triangles[t, 1]], places[triangles[t, 2]]
        ux, uy, uz, vx, vy, vz = b[0] - a[0], b[1] - a[1], b[2] - a[2], c[0] - a[0], c[1] - a[1], c[2] - a[2]
        normals[t, 0] = 0.5 * (uy * vz - uz * vy)
        normals[t, 1] = 0.5 * (uz * vx - ux * vz)
        normals[t, 2] = 0.5 * (ux * vy - uy * vx)
    return normals


@njit(cache=True, nogil=True)
def flatness(normals, group, groups):
    """Sum of the area normals by the area (g,) of each group of triangles; normals that point back are turned."""
    sums, area, lead = np.zeros((groups, 3)), np.zeros(groups), np.zeros((groups, 3))
    for t in range(group.shape[0]):
        g, n = group[t], normals[t]
        size = np.sqrt(n[0] ** 2 + n[1] ** 2 + n[2] ** 2)
        if area[g] == 0.0:
            lead[g] = n
        turn = 1.0 if n[0] * lead[g, 0] + n[1] * lead[g, 1] + n[2] * lead[g, 2] >= 0 else -1.0
        area[g] += size
        for axis in range(3):
            sums[g, axis] += turn * n[axis]
    flat = np.empty(groups)
    for g in range(groups):
        flat[g] = np.sqrt((sums[g] ** 2).sum()) / max(area[g], 1e-300)
    return flat


@njit(cache=True, nogil=True)
def blades_of(triangles, normals):
    """Leaf (t,) that each triangle belongs to, and the count of leaves.

    Triangles with a common edge, that is not bent sharply, are of one leaf; where that is no flat one each triangle is.
    """
    count, size = triangles.shape[0], 64
    while size < 4 * count:
        size *= 2
    table, above = np.full(size, -1, np.int32), np.arange(count).astype(np.int32)
    for t in range(count):
        for k in range(3):
            i, j = triangles[t, k], triangles[t, (k + 1) % 3]
            a, b = min(i, j), max(i, j)
            at = _bucket(a, b, 0, size - 1)
            while table[at] >= 0:
                e = table[at]
                x, y = triangles[e // 3, e % 3], triangles[e // 3, (e % 3 + 1) % 3]
                if min(x, y) == a and max(x, y) == b:
                    if _go_on(normals, t, e // 3):
                        p, q = root_of(above, t), root_of(above, e // 3)
                        above[max(p, q)] = min(p, q)
                    break
                at = (at + 1) & (size - 1)
            if table[at] < 0:
                table[at] = 3 * t + k
    leaf, leaves = _numbered(above)
    flat = flatness(normals, leaf, leaves)
    if flat.min() > FLAT:
        return leaf, leaves
    for t in range(count):
        if flat[leaf[t]] <= FLAT:
            above[t] = t
        else:
            above[t] = root_of(above, t)
    return _numbered(above)


@njit(cache=True, nogil=True)
def _numbered(above):
    """Number (t,) of the set of each triangle in order, and their count."""
    number, found = np.empty(above.shape[0], np.int32), 0
    for t in range(above.shape[0]):
        a = root_of(above, t)
        if a == t:
            number[t] = found
            found += 1
        else:
            number[t] = number[a]
    return number, found


@njit(inline="always")
def _go_on(normals, s, t):
    a, b = normals[s], normals[t]
    dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    sizes = (a[0] ** 2 + a[1] ** 2 + a[2] ** 2) * (b[0] ** 2 + b[1] ** 2 + b[2] ** 2)
    return dot * dot > _BEND * _BEND * sizes


@njit(inline="always")
def _sorted(corners):
    a, b, c = corners[0], corners[1], corners[2]
    low, high = min(a, min(b, c)), max(a, max(b, c))
    return low, a + b + c - low - high, high


@njit(inline="always")
def _bucket(x, y, z, mask):
    return (((x + 1) * 2654435761) ^ ((y + 1) * 40503417) ^ ((z + 1) * 83492791)) & mask
