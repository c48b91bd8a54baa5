"""Stems: the branch graph cut into chains of rings, each with a frame that does not twist; knows nothing of faces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant import Plant

THINNEST = 1e-4  # radius in plant heights under which a ring would be a heap of equal points
SHORTEST = 1e-5  # distance in plant heights under which two rings are one
ON_AXIS = 2e-6  # distance in plant heights to the parent's axis; single precision is off by a tenth of that


@dataclass(frozen=True, eq=False)
class Stems:
    """Rings (r,) in order along their stems; `first` (s + 1,) are the rings where stems begin."""

    first: NDArray[np.int64]  # (s + 1,), the last entry is r
    level: NDArray[np.int32]  # (s,)
    centre: NDArray[np.float64]  # (r, 3) m
    radius: NDArray[np.float64]  # (r,) m
    tangent: NDArray[np.float64]  # (r, 3) unit, along the stem
    side: NDArray[np.float64]  # (r, 3) unit, at right angles to the tangent
    along: NDArray[np.float64]  # (r,) m from where the stem begins
    narrowing: NDArray[np.float64]  # (r,) loss of radius per metre


def stems_of(plant: Plant) -> Stems:
    """Return the stems of `plant`: the first child of the same level goes on, every other child begins a stem.

    A stem that begins at a fork has its first ring at the parent vertex, so inside the parent's wood. When its
    first segment runs along the parent's axis to a seat between two vertices, it has it at that seat.
    """
    position = np.ascontiguousarray(plant.position, dtype=np.float64)
    size = max(float(np.ptp(position, axis=0).max()), 1e-6)
    parent, level = np.ascontiguousarray(plant.parent), np.ascontiguousarray(plant.level)
    following = _following(parent, level)
    seated = _seated(parent, level, position, ON_AXIS * size)
    first, vertex, owner = _chains(parent, following, seated, position, SHORTEST * size)
    centre = position[vertex]
    radius = np.maximum(_ring_radius(plant, vertex, owner), THINNEST * size)
    tangent, side, along = _frames(first, centre)
    level = np.asarray(plant.level[owner[first[:-1]]], dtype=np.int32)
    return Stems(first, level, centre, radius, tangent, side, along, narrowing(first, along, radius))


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


@njit(cache=True, nogil=True)
def _distance(point, begin, end):
    """Distance of a point (3,) to the segment from `begin` to `end`."""
    along, to_point = end - begin, point - begin
    share = (along * to_point).sum() / max((along**2).sum(), 1e-30)
    return np.sqrt(((to_point - min(max(share, 0.0), 1.0) * along) ** 2).sum())


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


@njit(cache=True, nogil=True)
def _frames(first, centre):
    """Tangent (r, 3), side (r, 3) carried along without twist, and length along the stem (r,)."""
    rings = centre.shape[0]
    tangent = np.zeros((rings, 3))
    side = np.zeros((rings, 3))
    along = np.zeros(rings)
    for stem in range(first.shape[0] - 1):
        low, high = first[stem], first[stem + 1]
        before = np.zeros(3)
        for i in range(low, high):
            after = np.zeros(3)
            if i + 1 < high:
                after = centre[i + 1] - centre[i]
                length = np.sqrt((after**2).sum())
                after /= length
                along[i + 1] = along[i] + length
            middle = before + after
            norm = np.sqrt((middle**2).sum())
            tangent[i] = middle / norm if norm > 1e-6 else (after if i + 1 < high else before)
            before = after
            t = tangent[i]
            previous = side[i - 1] if i > low else np.zeros(3)
            straight = previous - t * (previous * t).sum()
            norm = np.sqrt((straight**2).sum())
            if norm < 1e-6:
                axis = np.zeros(3)
                axis[np.argmin(np.abs(t))] = 1.0
                straight = axis - t * (axis * t).sum()
                norm = np.sqrt((straight**2).sum())
            side[i] = straight / norm
    return tangent, side, along


def narrowing(first: NDArray[np.int64], along: NDArray[np.float64], radius: NDArray[np.float64]) -> NDArray[np.float64]:
    """Loss of radius per metre (r,), over the segments before and after each ring."""
    index = np.arange(len(along))
    before, after = index - 1, index + 1
    before[first[:-1]] = first[:-1]
    after[first[1:] - 1] = first[1:] - 1
    loss: NDArray[np.float64] = (radius[before] - radius[after]) / (along[after] - along[before])
    return loss
