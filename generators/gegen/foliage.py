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
_ZERO, _ONE, _HALF, _TINY = (np.float32(x) for x in (0.0, 1.0, 0.5, 1e-9))
_TURN = np.float32(1 / (2 * math.pi))


@njit(**ONCE)
def put_leaves(rule, tree, n, shade, scale, world, leaves):
    """Fill `leaves` (11, k): position, axis, normal, size, in internodes; return (leaves, whether some were cut)."""
    joint, node, _, stem, key = tree
    k = 0
    ca, sa = circle(np.float32(rule.leaf_angle) * _TURN)
    length, width = np.float32(rule.leaf_length), np.float32(rule.leaf_width)
    number, power = np.float32(rule.leaf_number), np.float32(rule.leaf_light)
    unit = np.float32(_ONE / rule.height)
    if number <= 0:
        return 0, False
    for i in range(1, n):
        if stem[node[i, AXIS], DEAD] or stem[node[i, AXIS], LAST] - node[i, BORN] >= rule.leaf_years:
            continue
        x, y, z = joint[i, X], joint[i, Y], joint[i, Z]
        light = light_at(shade, x, y, z, scale)
        own = child_key(key[node[i, AXIS]], node[i, ORDER] + PLACES)
        count = int(number * light**power + uniform(own, LEAF))
        dx, dy, dz = joint[i, DX], joint[i, DY], joint[i, DZ]
        ax, ay = -dy + np.float32(1e-3), dx
        size = _ONE / math.sqrt(ax * ax + ay * ay + _TINY)
        ax, ay = ax * size, ay * size
        bx, by, bz = -dz * ay, dz * ax, dx * ay - dy * ax
        for leaf in range(count):
            if k >= leaves.shape[1]:
                return k, True
            u, v = two(child_key(own, LEAF + 1 + leaf))
            c, s = circle(np.float32(leaf) * np.float32(0.38) + u)
            lx = ca * dx + sa * (c * ax + s * bx)
            ly = ca * dy + sa * (c * ay + s * by)
            lz = ca * dz + sa * (s * bz)
            px, py, pz = x - v * dx, y - v * dy, z - v * dz
            if lz * length + pz < 0:
                lz = -lz
            size = _ONE / math.sqrt(lx * lx + ly * ly + lz * lz + _TINY)
            lx, ly, lz = lx * size, ly * size, lz * size
            if world.solid and blocked(world, px, py, pz, lx * length, ly * length, lz * length, unit, LEAF_ROOM):
                continue
            flat = math.sqrt(lx * lx + ly * ly) + np.float32(1e-6)
            leaves[0, k], leaves[1, k], leaves[2, k] = px, py, pz
            leaves[3, k], leaves[4, k], leaves[5, k] = lx, ly, lz
            leaves[6, k], leaves[7, k], leaves[8, k] = -lz * lx / flat, -lz * ly / flat, flat
            leaves[9, k], leaves[10, k] = length, width
            k += 1
    return k, False
