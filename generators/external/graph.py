"""Graph: the vertices of a foreign tree in the order that a Plant has, and which stem each belongs to."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Whole = NDArray[np.int32]


def order_of(parent: Whole) -> Whole | None:
    """Order (v,) in which each vertex comes after its parent; None when they already are.

    ValueError when there is not one root, a parent is no vertex, or parents go in a circle.
    """
    count, roots = len(parent), np.flatnonzero(parent < 0)
    if len(roots) != 1:
        raise ValueError(f"tree: needs one root, a vertex whose parent is -1, has {len(roots)}")
    if parent.max() >= count:
        raise ValueError(f"tree: parent {parent.max()} is no vertex, there are {count}")
    if roots[0] == 0 and _in_order(parent):
        return None
    order, reached = _outwards(parent, np.int32(roots[0]))
    if reached < count:
        lost = np.setdiff1d(np.arange(count), order[:reached])
        raise ValueError(f"tree: parents go in a circle: vertex {lost[0]} has no way to the root")
    return np.asarray(order, np.int32)


@njit(cache=True, nogil=True)
def levels_of(parent, radius):
    """Level (v,) of every vertex of a graph in order.

    A stem goes on where its child is thickest, the first one among equals; every other child begins a stem.
    """
    count = len(parent)
    heir = np.full(count, -1, np.int32)
    for i in range(1, count):
        best = heir[parent[i]]
        if best < 0 or radius[i] > radius[best]:
            heir[parent[i]] = i
    level = np.zeros(count, np.int32)
    for i in range(1, count):
        level[i] = level[parent[i]] + (0 if heir[parent[i]] == i else 1)
    return level


def _in_order(parent: Whole) -> bool:
    return bool((parent[1:] < np.arange(1, len(parent))).all())


@njit(cache=True, nogil=True)
def _outwards(parent, root):
    """Vertices from the root outwards (v,), siblings as they came, and how many of them there is a way to."""
    count = len(parent)
    first = np.zeros(count + 2, np.int32)
    for i in range(count):
        first[parent[i] + 2] += 1
    for i in range(1, count + 2):
        first[i] += first[i - 1]
    children, room = np.empty(count, np.int32), first.copy()
    for i in range(count):
        children[room[parent[i] + 1]] = i
        room[parent[i] + 1] += 1
    order = np.empty(count, np.int32)
    order[0], reached, done = root, 1, 0
    while done < reached:
        here = order[done]
        for k in range(first[here + 1], first[here + 2]):
            order[reached] = children[k]
            reached += 1
        done += 1
    return order, reached
