"""Seats: where on the wood of its parent each stem begins."""

from __future__ import annotations

import numpy as np
from numba import njit


@njit(cache=True, nogil=True)
def seats(parent, level, position, near):
    """Vertex (v,) at whose segment, one of the parent's stem, a segment to a new level lies hidden; -1 elsewhere."""
    n = parent.shape[0]
    last, before = np.full(n, -1, np.int64), np.full(n, -1, np.int64)  # children of their parent's level, as lists
    for i in range(1, n):
        if level[i] == level[parent[i]]:
            before[i], last[parent[i]] = last[parent[i]], i
    seat = np.full(n, -1, np.int64)
    for i in range(1, n):
        p = parent[i]
        if level[i] > level[p]:
            on = last[p]
            while on >= 0 and seat[i] < 0:
                if _distance(position[i], position[p], position[on]) <= near:
                    seat[i] = on
                on = before[on]
    return seat


@njit(cache=True, nogil=True)
def hosts(first, start, parent, seat, ring, centre, position):
    """Ring (s,) of another stem at or after which each stem begins, and the share (s,) of the way to the next one.

    `first` (s + 1,) are the first rings and `start` (s,) the first vertices of the stems; the root's has no host, -1.
    """
    host, share = np.full(start.shape[0], -1, np.int64), np.zeros(start.shape[0])
    begins = np.zeros(centre.shape[0], np.bool_)
    begins[first[:-1]] = True
    for s in range(start.shape[0]):
        i = start[s]
        if i == 0:
            continue
        host[s] = ring[parent[i]]
        if seat[i] >= 0 and not begins[ring[seat[i]]]:
            host[s] = ring[seat[i]] - 1
            share[s] = share_along(position[i], centre[host[s]], centre[host[s] + 1])
    return host, share


@njit(inline="always")
def _distance(point, begin, end):
    """Distance of a point (3,) to the segment from `begin` to `end`."""
    share = share_along(point, begin, end)
    far = 0.0
    for axis in range(3):
        far += (point[axis] - begin[axis] - share * (end[axis] - begin[axis])) ** 2
    return np.sqrt(far)


@njit(inline="always")
def share_along(point, begin, end):
    """Share in [0, 1] of the way from `begin` to `end` at which it is nearest to a point (3,)."""
    along = to_point = 0.0
    for axis in range(3):
        step = end[axis] - begin[axis]
        along += step * step
        to_point += step * (point[axis] - begin[axis])
    return min(max(to_point / max(along, 1e-30), 0.0), 1.0)
