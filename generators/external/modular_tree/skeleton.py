"""Skeleton: the stems of modular-tree out of its mesh, which is all that the package gives; exact, not fitted.

The package's BasicMesher draws a ring of corners around every node, one tube after the other: a stem to its tip, then
the stems on it from the tip down, each with its own stems behind it. So a stem's parent is one of the few still open,
and the first ring of a stem stands on the parent's axis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant.compiling import FAST, INNER

CORNERS = 8
"""Corners of a ring, as the package has them."""

_NEAR = 1e-6  # of the tree's size, how far from an axis what stands on it may be: single precision leaves 1e-7

Floats = NDArray[np.float32]
Ints = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Nodes of a tree in the order of the mesh, in metres; stem s has the nodes from starts[s] to starts[s + 1]."""

    position: Floats  # (v, 3) m
    radius: Floats  # (v,) m
    parent: Ints  # (v,), the node behind; of a stem's first node the parent's node under it
    level: Ints  # (v,), 0 is the trunk
    starts: Ints  # (stems + 1,)
    birth: Ints  # (stems,) how many stems of the same parent came before


def skeleton_of(vertices: Floats, polygons: Ints) -> Skeleton:
    """Skeleton of a mesh of tubes: corners `vertices` (v * CORNERS * 3,), four of them a polygon `polygons` (p * 4,).

    ValueError when the mesh is empty or is no mesh of such tubes.
    """
    if len(polygons) == 0 or len(vertices) % (3 * CORNERS):
        raise ValueError(f"modular-tree made no tree: {len(vertices) // 3} vertices, {len(polygons) // 4} faces")
    rings = vertices.reshape(-1, CORNERS, 3)
    position = (rings[:, 0] + rings[:, CORNERS // 2]) * np.float32(0.5)
    across = rings[:, 0] - position
    radius = np.sqrt((across * across).sum(axis=1))
    ends = np.ones(len(rings), bool)  # no face goes on from the last ring of a tube
    ends[polygons[:: 4 * CORNERS] // CORNERS] = False
    starts = np.concatenate([[0], np.flatnonzero(ends) + 1]).astype(np.int32)
    parent = np.arange(-1, len(rings) - 1, dtype=np.int32)
    level, birth, stack = np.empty_like(parent), np.empty_like(starts[1:]), np.empty((3, len(starts)), np.int32)
    lost = _join(position, starts, _NEAR * float(np.abs(position).max()), parent, level, birth, stack)
    if lost >= 0:
        raise ValueError(f"modular-tree made a stem that stands on no other (number {lost})")
    return Skeleton(position, radius, parent, level, starts, birth)


@njit(**FAST)
def _join(position: Floats, starts: Ints, near: float, parent: Ints, level: Ints, birth: Ints, stack: Ints) -> int:
    """Fill level, birth and the parents of first nodes; return the stem that has no parent, or -1.

    `stack` (3, stems) holds first node, node last grown from and count of stems on it, of the open stems.
    """
    first, node, count = stack
    depth = 0
    for stem in range(len(starts) - 1):
        at, end = starts[stem], starts[stem + 1]
        birth[stem] = 0
        while depth > 0:
            under = _under(position, at, near, first[depth - 1], node[depth - 1])
            if under >= 0:
                node[depth - 1], parent[at] = under, under
                birth[stem] = count[depth - 1]
                count[depth - 1] += 1
                break
            depth -= 1
        if depth == 0 and stem > 0:
            return stem
        first[depth], node[depth], count[depth] = at, end - 2, 0
        for i in range(at, end):
            level[i] = depth
        depth += 1
    return -1


@njit(**INNER)
def _under(position: Floats, at: int, near: float, first: int, last: int) -> int:
    """The node from `last` down to `first` from which the axis passes node `at` `near` metres off, or -1."""
    for i in range(last, first - 1, -1):
        along = whole = apart = 0.0
        for axis in range(3):
            step = np.float64(position[i + 1, axis]) - np.float64(position[i, axis])
            offset = np.float64(position[at, axis]) - np.float64(position[i, axis])
            along += step * offset
            whole += step * step
            apart += offset * offset
        t = min(max(along / whole, 0.0), 1.0) if whole > 0.0 else 0.0
        if apart - t * (2.0 * along - t * whole) < near * near:
            return i
    return -1
