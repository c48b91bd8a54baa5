"""Chains: the branch graph cut into stems, each a chain of rings; what a mesh of the plant is made along."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant.plant import Plant
from treefit.plant.seats import hosts, seats

THINNEST = 1e-4  # radius in plant sizes under which a ring would be a heap of equal points
SHORTEST = 1e-5  # distance in plant sizes under which two rings are one
ON_AXIS = 2e-6  # distance in plant sizes to the parent's axis; single precision is off by a tenth of that


@dataclass(frozen=True, eq=False)
class Chains:
    """Rings (r,) in order along their stems; `first` (s + 1,) are the rings where stems begin."""

    first: NDArray[np.int64]  # (s + 1,), the last entry is r
    level: NDArray[np.int32]  # (s,)
    centre: NDArray[np.float64]  # (r, 3) m
    radius: NDArray[np.float64]  # (r,) m

    def __len__(self) -> int:
        """Count of stems."""
        return len(self.level)


@dataclass(frozen=True, eq=False)
class JoinedChains(Chains):
    """Chains that know where on each other they begin."""

    host: NDArray[np.int64]  # (s,) ring of another stem that the stem begins at or after, -1 at the root
    share: NDArray[np.float64]  # (s,) of the way from there to the next ring of that stem
    ring: NDArray[np.int64]  # (v,) ring of each vertex of the plant
    size: float  # m, the longest side of the plant


def chains_of(plant: Plant) -> JoinedChains:
    """Return the stems of `plant`: the first child of the same level goes on, every other child begins a stem.

    A stem that begins at a fork has its first ring at the parent vertex, so inside the parent's wood. When its
    first segment runs along the parent's axis to a seat between two vertices, it has it at that seat.
    """
    position, parent, size = _position(plant), np.ascontiguousarray(plant.parent), _size(plant)
    (first, vertex, owner), ring, seat = _cut(plant, position, parent, size)
    radius = np.maximum(_ring_radius(plant, vertex, owner), THINNEST * size)
    start, centre = owner[first[:-1]], position[vertex]
    host, share = hosts(first, start, parent, seat, ring, centre, position)
    level = np.asarray(plant.level[start], dtype=np.int32)
    return JoinedChains(first, level, centre, radius, host, share, ring, size)


Cut = tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]


def _cut(
    plant: Plant, position: NDArray[np.float64], parent: NDArray[np.int32], size: float
) -> tuple[Cut, NDArray[np.int64], NDArray[np.int64]]:
    """Return `first` (s + 1,), vertices (r,) at rings, vertices (r,) whose segments they are of; rings, seats (v,)."""
    level = np.ascontiguousarray(plant.level)
    seat = seats(parent, level, position, ON_AXIS * size)
    first, vertex, owner, ring = _chains(parent, _following(parent, level), seat, position, SHORTEST * size)
    return (first, vertex, owner), ring, seat


def _position(plant: Plant) -> NDArray[np.float64]:
    return np.ascontiguousarray(plant.position, dtype=np.float64)


def _size(plant: Plant) -> float:
    return max(1e-6, *(float(row.max()) - float(row.min()) for row in plant.rows[0]))


def _ring_radius(plant: Plant, vertex: NDArray[np.int64], owner: NDArray[np.int64]) -> NDArray[np.float64]:
    """Radius (r,) m; a stem of a new level begins with the radius of its first own vertex."""
    radius = np.asarray(plant.radius, dtype=np.float64)
    begins_level = (vertex != owner) & (plant.level[owner] > plant.level[vertex])
    return np.where(begins_level, radius[owner], radius[vertex])


@njit(cache=True, nogil=True)
def _following(parent, level):
    """Vertex (v,) that continues the stem of each vertex, -1 at a tip."""
    following = np.full(parent.shape[0], -1, np.int64)
    for i in range(1, parent.shape[0]):
        p = parent[i]
        if following[p] < 0 and level[i] == level[p]:
            following[p] = i
    return following


@njit(cache=True, nogil=True)
def _chains(parent, following, seat, position, shortest):
    """First rings (s + 1,), the vertex (r,) at each ring, the vertex (r,) whose segment it has, the ring (v,) of each.

    A vertex that is where the one before it is has its ring; one of a stem without length that of its parent.
    """
    n = parent.shape[0]
    first = np.zeros(n + 1, np.int64)
    vertex, owner = np.zeros(2 * n, np.int64), np.zeros(2 * n, np.int64)
    ring = np.zeros(n, np.int64)
    stems = rings = 0
    for start in range(n):
        if start > 0 and following[parent[start]] == start:
            continue
        begin, i = rings, start
        vertex[rings] = start if start == 0 or seat[start] >= 0 else parent[start]
        owner[rings] = start
        rings += 1
        if start == 0:
            i = following[0]
        while i >= 0:
            gap = 0.0
            for axis in range(3):
                gap += (position[i, axis] - position[vertex[rings - 1], axis]) ** 2
            if gap > shortest * shortest:
                vertex[rings] = owner[rings] = i
                rings += 1
            ring[i] = rings - 1
            i = following[i]
        if rings - begin < 2:
            rings, i = begin, start
            while i > 0:
                ring[i] = ring[parent[start]]
                i = following[i]
        else:
            first[stems] = begin
            stems += 1
    first[stems] = rings
    return first[: stems + 1].copy(), vertex[:rings].copy(), owner[:rings].copy(), ring
