"""Leaves of GEGen: on young shoots, as many as the light there feeds."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.gegen.field import light_at
from generators.gegen.obstacles import LEAF_ROOM, blocked
from generators.gegen.shoots import PLACES
from generators.gegen.tree import AXIS, BORN, DEAD, DX, DY, DZ, LAST, ORDER, X, Y, Z
from treefit.plant.compiling import ONCE
from treefit.plant.streams import child_key, circle, two, uniform

LEAF = 64
"""Purpose of the draw of a joint that rounds the number of its leaves; those after it are the leaves'."""
AROUND = np.float32(0.38)
"""Turns from one leaf of a joint to the next: the golden angle."""
_ZERO, _ONE, _TINY = (np.float32(x) for x in (0.0, 1.0, 1e-9))
_TURN = np.float32(1 / (2 * math.pi))


@njit(**ONCE)
def put_leaves(rule, tree, n, shade, scale, world, leaves):
    """Fill `leaves` (11, k): position, axis, normal, size, in internodes; return (leaves, whether some were cut)."""
    joint, node, _, stem, key = tree
    k, number, power = 0, np.float32(rule.leaf_number), np.float32(rule.leaf_light)
    cosine, sine = circle(np.float32(rule.leaf_angle) * _TURN)
    for i in range(1, n):
        a = node[i, AXIS]
        if number <= 0 or stem[a, DEAD] or stem[a, LAST] - node[i, BORN] >= rule.leaf_years:
            continue
        own = child_key(key[a], node[i, ORDER] + PLACES)
        light = light_at(shade, joint[i, X], joint[i, Y], joint[i, Z], scale)
        for leaf in range(int(number * light**power + uniform(own, LEAF))):
            if k >= leaves.shape[1]:
                return k, True
            k += _put_leaf(rule, joint[i], child_key(own, LEAF + 1 + leaf), leaf, cosine, sine, world, leaves, k)
    return k, False


@njit(**ONCE)
def _put_leaf(rule, at, key, leaf, cosine, sine, world, leaves, k):
    """Put a leaf of a joint on the internode below it, over the ground; return 1, or 0 where an obstacle is."""
    u, v = two(key)
    c, s = circle(np.float32(leaf) * AROUND + u)
    dx, dy, dz = at[DX], at[DY], at[DZ]
    ax, ay = -dy + np.float32(1e-3), dx  # level, at right angles to the shoot
    inverse = _ONE / math.sqrt(ax * ax + ay * ay + _TINY)
    ax, ay = ax * inverse, ay * inverse
    bx, by, bz = -dz * ay, dz * ax, dx * ay - dy * ax
    lx, ly = cosine * dx + sine * (c * ax + s * bx), cosine * dy + sine * (c * ay + s * by)
    lz = cosine * dz + sine * s * bz
    x, y, z = at[X] - v * dx, at[Y] - v * dy, at[Z] - v * dz
    length = np.float32(rule.leaf_length)
    if lz * length + z < 0:
        lz = -lz
    inverse = _ONE / math.sqrt(lx * lx + ly * ly + lz * lz + _TINY)
    lx, ly, lz = lx * inverse, ly * inverse, lz * inverse
    unit = np.float32(_ONE / rule.leader)
    if world.solid and blocked(world, x, y, z, lx * length, ly * length, lz * length, unit, LEAF_ROOM):
        return 0
    flat = math.sqrt(lx * lx + ly * ly) + np.float32(1e-6)
    leaves[0, k], leaves[1, k], leaves[2, k] = x, y, z
    leaves[3, k], leaves[4, k], leaves[5, k] = lx, ly, lz
    leaves[6, k], leaves[7, k], leaves[8, k] = -lz * lx / flat, -lz * ly / flat, flat
    leaves[9, k], leaves[10, k] = length, np.float32(rule.leaf_width)
    return 1
