"""Chains: the branch graph cut into stems, each a chain of rings; what a mesh of the plant is made along."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant.plant import Plant

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


def chains_of(plant: Plant) -> Chains:
    """Return the stems of `plant`: the first child of the same level goes on, every other child begins a stem.

    A stem that begins at a fork has its first ring at the parent vertex, so inside the parent's wood. When its
    first segment runs along the parent's axis to a seat between two vertices, it has it at that seat.
    """
    position = np.ascontiguousarray(plant.position, dtype=np.float64)
    size = max(1e-6, *(float(row.max()) - float(row.min()) for row in plant.rows[0]))
    parent, level = np.ascontiguousarray(plant.parent), np.ascontiguousarray(plant.level)
    following = _following(parent, level)
    seated = _seated(parent, level, position, ON_AXIS * size)
    first, vertex, owner = _chains(parent, following, seated, position, SHORTEST * size)
    radius = np.maximum(_ring_radius(plant, vertex, owner), THINNEST * size)
    return Chains(first, np.asarray(level[owner[first[:-1]]], dtype=np.int32), position[vertex], radius)


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
def _seated(parent, level, position, near):
    """True (v,) where a segment to a new level lies on a segment of the parent's stem, so hidden in its wood."""
    n = parent.shape[0]
    last, before = np.full(n, -1, np.int64), np.full(n, -1, np.int64)  # children of their parent's level, as lists
    for i in range(1, n):
        if level[i] == level[parent[i]]:
            before[i], last[parent[i]] = last[parent[i]], i
    seated = np.zeros(n, np.bool_)
    for i in range(1, n):
        p = parent[i]
        if level[i] > level[p]:
            on = last[p]
            while on >= 0 and not seated[i]:
                seated[i] = _distance(position[i], position[p], position[on]) <= near
                on = before[on]
    return seated


@njit(inline="always")
def _distance(point, begin, end):
    """Distance of a point (3,) to the segment from `begin` to `end`."""
    along = to_point = 0.0
    for axis in range(3):
        step = end[axis] - begin[axis]
        along += step * step
        to_point += step * (point[axis] - begin[axis])
    share = min(max(to_point / max(along, 1e-30), 0.0), 1.0)
    far = 0.0
    for axis in range(3):
        far += (point[axis] - begin[axis] - share * (end[axis] - begin[axis])) ** 2
    return np.sqrt(far)


@njit(cache=True, nogil=True)
def _chains(parent, following, seated, position, shortest):
    """First rings (s + 1,), the vertex (r,) at each ring and the vertex (r,) whose segment it belongs to."""
    n = parent.shape[0]
    first = np.zeros(n + 1, np.int64)
    vertex = np.zeros(2 * n, np.int64)
    owner = np.zeros(2 * n, np.int64)
    stems = rings = 0
    for start in range(n):
        if start > 0 and following[parent[start]] == start:
            continue
        begin, i = rings, start
        vertex[rings] = start if start == 0 or seated[start] else parent[start]
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
            i = following[i]
        if rings - begin < 2:
            rings = begin
        else:
            first[stems] = begin
            stems += 1
    first[stems] = rings
    return first[: stems + 1].copy(), vertex[:rings].copy(), owner[:rings].copy()
