"""Stems: joined rings become the vertices of a branch graph, in order, with levels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.external.mesh.joining import Joints
from generators.external.mesh.near import to_segment
from generators.external.mesh.rings import Rings

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_ON_AXIS = 0.3  # of its own radius: so far off the axis of its parent a stem begins there by itself


_LEVEL = 1e-4  # of the height: so near to the ground is at the ground


@dataclass(frozen=True, eq=False)
class Stems:
    """Vertices of the branch graph, as in a Plant."""

    position: Floats  # (v, 3) m
    radius: Floats  # (v,) m
    parent: Ints  # (v,)
    level: Ints  # (v,)


def stems_of(rings: Rings, joints: Joints) -> Stems:
    """Return the branch graph of joined pieces, the trunk's base first."""
    position, radius, parent, new = _graph(rings.centre, rings.radius, rings.parent, joints.start, joints.host)
    buried = _buried(position, parent)
    if buried:
        above, below = position[buried], position[buried - 1]
        share = max(below[2] / (below[2] - above[2]), 0.0)  # it may be at the ground, or a hair above
        position[buried - 1] = below + share * (above - below)
        radius[buried - 1] += share * (radius[buried] - radius[buried - 1])
        first = buried - 1
        position, radius, new = position[first:], radius[first:], new[first:]
        parent = np.maximum(parent[first:] - first, -1)
    return Stems(position, radius, parent, _levels(position, radius, parent, new))


def _buried(position: Floats, parent: Ints) -> int:
    """Count of vertices of the trunk that are under the ground, z = 0, where it then comes out; 0 for none."""
    ground = _LEVEL * float(position[:, 2].max())
    count = 0
    while count < len(parent) - 1 and position[count, 2] <= ground:
        if (parent == count).sum() != 1 or parent[count + 1] != count:
            return 0
        count += 1
    return count if position[0, 2] < -ground and position[count, 2] > ground else 0


@njit(cache=True, nogil=True)
def _graph(centre, thick, before, start, host):
    """Position, radius, parent of the vertices, and which of them begin a stem at the side of another one."""
    count = thick.shape[0]
    first, beside = _neighbours(before)
    most = count + start.shape[0]
    position, radius, parent = np.empty((most, 3)), np.empty(most), np.full(most, -1, np.int32)
    new, vertex, found = np.zeros(most, np.bool_), np.full(count, -1, np.int32), 0
    open_ = np.empty(count, np.int32)
    for n in range(start.shape[0]):
        i, j, on = start[n], host[n], -1
        if j >= 0:
            a, b = vertex[before[j]], vertex[j]  # a piece may have been turned round: a is to be the lower one
            a, b = (b, a) if parent[a] == b else (a, b)
            share, far = to_segment(centre[i], position[a], position[b])
            on = b if share > 0.999 else a
            if 0.001 < share <= 0.999:
                new[found] = True
                if far > _ON_AXIS * thick[i]:
                    position[found] = position[a] + share * (position[b] - position[a])
                    radius[found], parent[found], on = thick[i], a, found
                    found += 1
        vertex[i], parent[found], open_[0], waiting = found, on, i, 1
        found += 1
        while waiting > 0:
            waiting -= 1
            i = open_[waiting]
            position[vertex[i]], radius[vertex[i]] = centre[i], thick[i]
            for e in range(first[i], first[i + 1]):
                k = beside[e]
                if vertex[k] < 0:
                    vertex[k], parent[found] = found, vertex[i]
                    found += 1
                    open_[waiting] = k
                    waiting += 1
    return position[:found].copy(), radius[:found].copy(), parent[:found].copy(), new[:found].copy()


@njit(cache=True, nogil=True)
def _neighbours(before):
    """Rings beside each one on its piece as a list: `first` (m + 1,), `beside` (edges * 2,)."""
    count = before.shape[0]
    first = np.zeros(count + 1, np.int32)
    for i in range(count):
        if before[i] >= 0:
            first[i + 1] += 1
            first[before[i] + 1] += 1
    for i in range(count):
        first[i + 1] += first[i]
    filled, beside = first[:-1].copy(), np.empty(first[-1], np.int32)
    for i in range(count):
        p = before[i]
        if p >= 0:
            beside[filled[i]], beside[filled[p]] = p, i
            filled[i] += 1
            filled[p] += 1
    return first, beside


@njit(cache=True, nogil=True)
def _levels(position, radius, parent, new):
    """Level (v,): of the children of a vertex the one that is thickest and straightest goes on with its stem."""
    count = radius.shape[0]
    heir, best = np.full(count, -1, np.int32), np.full(count, -1.0)
    for i in range(1, count):
        p = parent[i]
        if new[i]:
            continue
        straight = 1.0
        if parent[p] >= 0:
            ahead, behind = position[i] - position[p], position[p] - position[parent[p]]
            lengths = np.sqrt((ahead**2).sum() * (behind**2).sum())
            straight = (ahead * behind).sum() / lengths if lengths > 0 else 0.0
        worth = radius[i] * (1.0 + straight)
        if worth > best[p]:
            heir[p], best[p] = i, worth
    level = np.zeros(count, np.int32)
    for i in range(1, count):
        level[i] = level[parent[i]] + (heir[parent[i]] != i)
    return level
