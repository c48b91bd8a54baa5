"""Cutting: wood that is one skin over all of its forks is cut into stems, each of which is then a tube by itself.

Swept from the tips down, by the distance from the base, what is farther off is one part for each stem that is still
alone; where two parts meet is a fork, and the one that reaches farther goes on. That is the merge tree of the distance,
as in Carr, Snoeyink and Axen, Computing contour trees in all dimensions, 2003.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.external.mesh.corners import corners_of, root_of

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_SWEEPS = 2  # times that distances are made shorter both ways: then few are not the shortest
_LEAST = 6  # corners that a stem has, at least; fewer are a bump of the other one


@dataclass(frozen=True, eq=False)
class Cut:
    """Stems of a welded mesh."""

    triangles: Ints  # (t, 3) that lie on one stem
    stem: Ints  # (n,) of each place that has triangles, numbered from 0
    source: NDArray[np.uint8]  # (n,) 1 where a stem begins
    beside: NDArray[np.bool_]  # (n,) at the foot of another stem: not on the round of its own
    bearer: Ints  # (s,) the stem that bears each, -1 for none


def cut(places: Floats, triangles: Ints, before: Ints, order: Ints, source: NDArray[np.uint8]) -> Cut:
    """Return the wood of `places` (n, 3), `triangles` (t, 3) cut into stems.

    `before` (n,) is the place before each on its way from the `source`, `order` the places by their distance.
    """
    first, around = corners_of(triangles, len(places))
    far = _distances(places, triangles, first, around, before, order)
    stem, bearer = _stems(triangles, first, around, far, np.argsort(-far, kind="stable").astype(np.int32))
    begins, beside = _begins(triangles, far, stem, bearer, source)
    own = stem[triangles]
    whole = (own[:, 0] == own[:, 1]) & (own[:, 0] == own[:, 2])
    there = np.bincount(stem[triangles.ravel()], minlength=len(stem)).astype(bool)
    numbers = (np.cumsum(there) - 1).astype(np.int32)
    bearer = bearer[there]
    return Cut(
        triangles[whole], numbers[stem], begins, beside, np.where(bearer >= 0, numbers[bearer], -1).astype(np.int32)
    )


@njit(cache=True, nogil=True)
def _distances(places, triangles, first, around, before, order):
    """Metres (n,) from the sources along edges."""
    far = np.zeros(places.shape[0])
    for i in order:
        if before[i] >= 0:
            far[i] = far[before[i]] + _length(places, i, before[i])
    for sweep in range(2 * _SWEEPS):
        for n in range(order.shape[0]):
            i = order[n if sweep % 2 == 0 else order.shape[0] - 1 - n]
            for e in range(first[i], first[i + 1]):
                for k in range(3):
                    j = triangles[around[e], k]
                    far[i] = min(far[i], far[j] + _length(places, i, j))
    return far


@njit(cache=True, nogil=True)
def _stems(triangles, first, around, far, downwards):
    """Stem (n,) of each place, named by its tip, and the stem (n,) that bears each one, -1 for none."""
    count = far.shape[0]
    above, tip, size = np.full(count, -1, np.int32), np.arange(count).astype(np.int32), np.zeros(count, np.int32)
    stem, same, bearer = np.empty(count, np.int32), np.arange(count).astype(np.int32), np.full(count, -1, np.int32)
    for i in downwards:
        above[i], size[i], main = i, 1, -1
        for e in range(first[i], first[i + 1]):
            for k in range(3):
                j = triangles[around[e], k]
                if j == i or above[j] < 0:
                    continue
                part = root_of(above, j)
                if main < 0:
                    main = part
                elif part != main:
                    less = main if far[tip[part]] > far[tip[main]] else part
                    main = part if less == main else main
                    if size[less] < _LEAST:
                        same[tip[less]] = tip[main]
                    else:
                        bearer[tip[less]] = tip[main]
                    above[less] = main
                    size[main] += size[less]
        if main >= 0:
            above[i] = main
            size[main] += 1
        stem[i] = tip[main] if main >= 0 else i
    for i in range(count):
        stem[i] = root_of(same, stem[i])
        if bearer[i] >= 0:
            bearer[i] = root_of(same, bearer[i])
    return stem, bearer


@njit(cache=True, nogil=True)
def _begins(triangles, far, stem, bearer, source):
    """Whether a stem begins with each place (n,), beside its bearer or at the base; and its bearer's places there."""
    begins, beside = np.zeros(far.shape[0], np.uint8), np.zeros(far.shape[0], np.bool_)
    for i in range(far.shape[0]):
        if source[i] and bearer[stem[i]] < 0:
            begins[i] = 1
    for t in range(triangles.shape[0]):
        for k in range(3):
            i, j = triangles[t, k], triangles[t, (k + 1) % 3]
            if bearer[stem[i]] == stem[j]:
                begins[i], beside[j] = 1, True
            elif bearer[stem[j]] == stem[i]:
                begins[j], beside[i] = 1, True
    return begins, beside


@njit(inline="always")
def _length(places, i, j):
    x, y, z = places[i, 0] - places[j, 0], places[i, 1] - places[j, 1], places[i, 2] - places[j, 2]
    return np.sqrt(x * x + y * y + z * z)
