"""Holes: the open ends of wood, of which the widest is where a piece of it begins."""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.external.mesh.corners import corners_of, root_of


@njit(cache=True, nogil=True)
def holes(places, triangles, piece, pieces, trunk, foot):
    """Which places (n,) are the hole that a piece begins with, and which pieces have one.

    The trunk's has its middle below the height `foot`.
    """
    count = places.shape[0]
    border = _borders(triangles, count)
    loop = _loops(triangles, border)
    sums, corners, size = np.zeros((count, 3)), np.zeros(count, np.int32), np.zeros(pieces, np.int32)
    for i in range(count):
        size[piece[i]] += 1
        if border[i]:
            a = root_of(loop, i)
            sums[a] += places[i]
            corners[a] += 1
    reach = np.zeros(count)
    for i in range(count):
        if border[i]:
            a = root_of(loop, i)
            reach[a] += np.sqrt(((places[i] - sums[a] / corners[a]) ** 2).sum()) / corners[a]
    best = np.full(pieces, -1, np.int32)
    worth = np.zeros(pieces)
    for a in range(count):
        p = piece[a]
        if corners[a] < 3 or corners[a] == size[p]:  # all of a piece is its border: a flat one, with no hole
            continue
        height = sums[a, 2] / corners[a]
        value = reach[a] if p != trunk else (1.0 + foot - height if height <= foot else 0.0)
        if value > worth[p]:
            best[p], worth[p] = a, value
    source = np.zeros(count, np.uint8)
    for i in range(count):
        if border[i] and root_of(loop, i) == best[piece[i]]:
            source[i] = 1
    return source, best >= 0


@njit(cache=True, nogil=True)
def _loops(triangles, border):
    """Representative (n,) of the hole that each place on a `border` lies at."""
    count = border.shape[0]
    first, around = corners_of(triangles, count)
    loop = np.arange(count).astype(np.int32)
    for i in range(count):
        if not border[i]:
            continue
        for e in range(first[i], first[i + 1]):
            for k in range(3):
                j = triangles[around[e], k]
                if j > i and border[j] and _shared(triangles, first, around, i, j) == 1:
                    a, b = root_of(loop, i), root_of(loop, j)
                    if a != b:
                        loop[max(a, b)] = min(a, b)
    return loop


@njit(cache=True, nogil=True)
def _borders(triangles, count):
    """Whether each place lies on a border: else each neighbour is in two triangles with it, and all cancel."""
    odd = np.zeros(count, np.int32)
    for t in range(triangles.shape[0]):
        a, b, c = triangles[t]
        odd[a] ^= b ^ c
        odd[b] ^= a ^ c
        odd[c] ^= a ^ b
    return odd != 0


@njit(inline="always")
def _shared(triangles, first, around, i, j):
    """Count of triangles with the places i and j."""
    found = 0
    for e in range(first[i], first[i + 1]):
        t = around[e]
        if triangles[t, 0] == j or triangles[t, 1] == j or triangles[t, 2] == j:
            found += 1
    return found
