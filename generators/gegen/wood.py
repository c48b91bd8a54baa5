"""Wood: radii by the pipe model (Shinozaki et al. 1964), shed branches remembered; the vertices of the plant."""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.gegen.tree import AXIS, DEAD, LATERALS, LEVEL, PARENT, WOOD, X, Y, Z
from treefit.plant.compiling import ONCE

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)


@njit(**ONCE)
def add_pipes(rule, tree, n):
    """Fill WOOD: r^pipe of every joint is the sum of those of what it bears; a tip is one pipe."""
    joint, node, _, stem, _ = tree
    wood = joint[:, WOOD]
    memory = np.float32(rule.shed_memory)
    for i in range(n):
        wood[i] = _ZERO
    for i in range(n - 1, 0, -1):
        wood[i] = max(wood[i], _ONE)
        a, p = node[i, AXIS], node[i, PARENT]
        shed = stem[a, DEAD] and not stem[node[p, AXIS], DEAD]
        wood[p] += memory * wood[i] if shed else wood[i]


@njit(**ONCE)
def write(rule, tree, n, numbers, integers):
    """Write place, radius, parent, level of the joints that live; return (vertices, whether some were cut)."""
    joint, node, _, stem, _ = tree
    m = 0
    inverse = np.float32(1.0 / rule.pipe)
    tip = np.float32(rule.tip_radius)
    place = node[:, LATERALS]
    for i in range(n):
        if stem[node[i, AXIS], DEAD]:
            continue
        if m >= numbers.shape[1]:
            return m, True
        numbers[0, m], numbers[1, m], numbers[2, m] = joint[i, X], joint[i, Y], joint[i, Z]
        numbers[3, m] = tip * joint[i, WOOD] ** inverse
        integers[0, m] = place[node[i, PARENT]] if i > 0 else -1
        integers[1, m] = stem[node[i, AXIS], LEVEL]
        place[i] = m
        m += 1
    return m, False
