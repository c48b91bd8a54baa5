"""Leaves of SimpleGen: at the joints of the last level."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.simplegen.directions import frame, unit
from treefit.plant.streams import child_key, circle, four, uniform

SPIN, ROLL, LEAF = 1, 2, 64  # purposes of draws, and the first number of a joint's leaves
_HALF, _SMALLEST, _SPREAD = np.float32(0.5), np.float32(0.7), np.float32(0.6)  # sizes are in 0.7 .. 1.3 of the mean


class LeafRule(NamedTuple):
    """Where leaves are and how big."""

    first: int  # vertex of the last level
    joints: int  # of a branch of the last level
    angle: float  # rad, to the branch
    probability: float
    number: int  # at each joint
    length: float  # m
    width: float  # m


class Leaves(NamedTuple):
    """Arrays of the leaves as rows: (3, k), (3, k), (3, k), (2, k)."""

    position: NDArray[np.float32]
    axis: NDArray[np.float32]
    normal: NDArray[np.float32]
    size: NDArray[np.float32]


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def grow_leaves(rule, keys, xyz, parent, n, leaves):
    """Put leaves at the vertices rule.first..n; return (count of leaves, whether the budget cut them)."""
    position, axis, normal, size = leaves
    k = 0
    cosine, sine = np.float32(math.cos(rule.angle)), np.float32(math.sin(rule.angle))
    length, width, share = np.float32(rule.length), np.float32(rule.width), np.float32(1.0 / rule.number)
    for v in range(rule.first, n):
        i = (v - rule.first) % rule.joints + 1
        joint = child_key(keys[(v - rule.first) // rule.joints], i)
        p = parent[v]
        x, y, z = xyz[0, v], xyz[1, v], xyz[2, v]
        sx, sy, sz = x - xyz[0, p], y - xyz[1, p], z - xyz[2, p]
        dx, dy, dz = unit(sx, sy, sz)
        ux, uy, uz, wx, wy, wz = frame(dx, dy, dz)
        spin = uniform(joint, SPIN)
        for j in range(rule.number):
            leaf = child_key(joint, LEAF + j)
            kept, turn, back, big = four(leaf)
            if kept >= rule.probability:
                continue
            if k >= position.shape[1]:
                return k, True
            c, s = circle(spin + (np.float32(j) + _HALF * turn) * share)
            ox, oy, oz = c * ux + s * wx, c * uy + s * wy, c * uz + s * wz  # outwards from the branch
            tx, ty, tz = c * wx - s * ux, c * wy - s * uy, c * wz - s * uz  # around it
            c, s = circle(uniform(leaf, ROLL))
            nx = c * tx + s * (cosine * ox - sine * dx)
            ny = c * ty + s * (cosine * oy - sine * dy)
            nz = c * tz + s * (cosine * oz - sine * dz)
            up = math.copysign(np.float32(1.0), nz)  # the upper side to the sky
            scale = _SMALLEST + _SPREAD * big
            position[0, k], position[1, k], position[2, k] = x - back * sx, y - back * sy, z - back * sz
            axis[0, k] = cosine * dx + sine * ox
            axis[1, k] = cosine * dy + sine * oy
            axis[2, k] = cosine * dz + sine * oz
            normal[0, k], normal[1, k], normal[2, k] = up * nx, up * ny, up * nz
            size[0, k], size[1, k] = length * scale, width * scale
            k += 1
    return k, False
