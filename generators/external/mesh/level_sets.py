"""Level sets: places of wood as far from its base as each other, counted in edges, as long as they hang together."""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.external.mesh.corners import corners_of, root_of, square


@njit(cache=True, nogil=True)
def distances(triangles, source):
    """Edges from the sources (n,), the place before each on the way (n,), and the places in the order of distance."""
    count = source.shape[0]
    first, around = corners_of(triangles, count)
    level, before, order = np.full(count, -1, np.int32), np.full(count, -1, np.int32), np.empty(count, np.int32)
    end = 0
    for i in range(count):
        if source[i]:
            level[i], order[end] = 0, i
            end += 1
    at = 0
    while at < end:
        i = order[at]
        at += 1
        for e in range(first[i], first[i + 1]):
            for k in range(3):
                j = triangles[around[e], k]
                if level[j] < 0:
                    level[j], before[j], order[end] = level[i] + 1, i, j
                    end += 1
    return level, before, order[:end]


@njit(cache=True, nogil=True)
def level_sets(triangles, level, before, order, source, piece):
    """Ring of each place (n,), in order of distance; the parent of each ring (m,), and its piece."""
    count = level.shape[0]
    above = np.arange(count).astype(np.int32)
    begins = np.full(count, -1, np.int32)  # of each piece: all its sources are one ring
    for i in order:
        if source[i]:
            if begins[piece[i]] < 0:
                begins[piece[i]] = i
            above[i] = begins[piece[i]]
    for t in range(triangles.shape[0]):
        for k in range(3):
            i, j = triangles[t, k], triangles[t, (k + 1) % 3]
            if level[i] == level[j] and level[i] > 0:
                a, b = root_of(above, i), root_of(above, j)
                if a != b:
                    above[max(a, b)] = min(a, b)
    named, ring, found = np.full(count, -1, np.int32), np.full(count, -1, np.int32), 0
    pieces, corners = np.empty(count, np.int32), np.zeros(count, np.int32)
    for i in order:
        a = root_of(above, i)
        if named[a] < 0:
            named[a], pieces[found] = found, piece[i]
            found += 1
        ring[i] = named[a]
        corners[ring[i]] += 1
    return ring, _parents(ring, before, order, corners[:found]), pieces[:found].copy()


@njit(cache=True, nogil=True)
def _parents(ring, before, order, corners):
    """Parent (m,) of each ring: of several rings before it the one with the most corners."""
    parent = np.full(corners.shape[0], -1, np.int32)
    for i in order:
        if before[i] >= 0:
            r, p = ring[i], ring[before[i]]
            if parent[r] < 0 or corners[p] > corners[parent[r]]:
                parent[r] = p
    return parent


@njit(cache=True, nogil=True)
def weights(places, triangles, level):
    """Length (n,) of the edges of each place along its ring: corners that lie close to each other count less."""
    weight = np.full(places.shape[0], 1e-12)
    for t in range(triangles.shape[0]):
        a, b, c = triangles[t]
        if level[a] == level[b] and level[a] == level[c]:
            continue  # of a cap: its edges go across
        for k in range(3):
            i, j = triangles[t, k], triangles[t, (k + 1) % 3]
            if level[i] == level[j]:
                length = np.sqrt(square(places[i], places[j]))
                weight[i] += length
                weight[j] += length
    return weight


@njit(cache=True, nogil=True)
def members_of(ring, order, count):
    """Places of each ring as a list: `first` (m + 1,), `members`."""
    first = np.zeros(count + 1, np.int32)
    for i in order:
        first[ring[i] + 1] += 1
    for r in range(count):
        first[r + 1] += first[r]
    filled, members = first[:-1].copy(), np.empty(order.shape[0], np.int32)
    for i in order:
        members[filled[ring[i]]] = i
        filled[ring[i]] += 1
    return first, members
