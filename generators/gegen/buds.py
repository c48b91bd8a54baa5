"""Lateral buds of GEGen: when they sprout and which way they set out."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.gegen.shoots import AIM, PLACES, extend
from generators.gegen.tree import (
    AGED,
    AXIS,
    BASE,
    BUDS,
    DEAD,
    DX,
    DY,
    DZ,
    FIRST,
    GIVEN,
    HEAD,
    KEPT,
    LATERALS,
    LEVEL,
    ORDER,
    OUT_X,
    OUT_Y,
    OUT_Z,
    START,
    STORE,
    TIP,
)  # fmt: skip
from treefit.plant.compiling import INNER
from treefit.plant.streams import child_key, circle, two, uniform

UNITS = 2
"""Purpose of the draw of a bud: the part of an internode that it has from the start."""
JITTER = np.float32(0.08)
"""Turns of azimuth that are random."""
_ZERO, _ONE, _HALF, _TINY = (np.float32(x) for x in (0.0, 1.0, 0.5, 1e-9))
_TURN = np.float32(1 / (2 * math.pi))


@njit(**INNER)
def sprout(rule, tree, j, amount, n, axes, bound, year, shade, scale, world):
    """Grow the lateral buds of a joint from `amount` of resource; return (joints, axes)."""
    joint, node, _, stem, key = tree
    a = node[AXIS, j]
    level, buds = stem[LEVEL, a], node[BUDS, j]
    joint[STORE, j] += min(amount / np.float32(buds), bound)
    first, stored = axes, joint[STORE, j]
    for bud in range(buds):
        own = child_key(child_key(key[a], node[ORDER, j] + PLACES), bud + PLACES)
        grown = stored + uniform(own, UNITS)
        if level == 0 and node[ORDER, j] == int(rule.trunk) and rule.forks > 0:
            grown = max(grown, _ONE)  # they begin together
        count = int(grown)
        if count == 0 or axes >= stem.shape[1]:
            continue
        dx, dy, dz = _lateral(rule, tree, j, level, bud, buds, own)
        tree.axis[OUT_X, axes], tree.axis[OUT_Y, axes], tree.axis[OUT_Z, axes] = dx, dy, dz
        stem[BASE, axes] = stem[TIP, axes] = j
        stem[HEAD, axes] = -1
        stem[LEVEL, axes], stem[START, axes], stem[AGED, axes], stem[DEAD, axes] = level + 1, year, 0, 0
        key[axes] = own
        tree.axis[KEPT, axes], tree.axis[GIVEN, axes] = grown - np.float32(count), _ZERO
        n = extend(rule, tree, axes, n, count, year, shade, scale, world)
        if stem[HEAD, axes] >= 0:
            axes += 1
    if axes > first:
        node[FIRST, j], node[LATERALS, j], node[BUDS, j] = first, axes - first, 0
    return n, axes


@njit(**INNER)
def _lateral(rule, tree, j, level, bud, buds, key):
    """Direction in which a lateral bud of a joint sets out."""
    joint, node = tree.joint, tree.node
    dx, dy, dz = joint[DX, j], joint[DY, j], joint[DZ, j]
    u, v = two(child_key(key, AIM))
    order = np.float32(node[ORDER, j])
    turn = order * np.float32(rule.phyllotaxis) + np.float32(bud) / np.float32(buds)
    turn += JITTER * (u - _HALF)
    forks = level == 0 and node[ORDER, j] == int(rule.trunk) and rule.forks > 0
    if forks:
        angle = rule.fork_angle
    elif level == 0:
        angle = rule.angle + (rule.angle_top - rule.angle) * min(node[ORDER, j] / rule.height, 1.0)
    else:
        angle = rule.angle_branches
    angle += rule.angle_variation * (2.0 * v - 1.0)
    turn -= math.floor(turn)
    c, s = circle(turn)
    if level == 0:
        ax, ay, az = _ONE - dx * dx, -dx * dy, -dx * dz
    else:
        ax, ay, az = -dy + np.float32(1e-3), dx, _ZERO
        s *= _ONE - np.float32(rule.flatness)
        dot = ax * dx + ay * dy
        ax, ay, az = ax - dot * dx, ay - dot * dy, -dot * dz
    size = _ONE / math.sqrt(ax * ax + ay * ay + az * az + _TINY)
    ax, ay, az = ax * size, ay * size, az * size
    bx, by, bz = dy * az - dz * ay, dz * ax - dx * az, dx * ay - dy * ax
    length = _ONE / math.sqrt(c * c + s * s + _TINY)
    c, s = c * length, s * length
    ca, sa = circle(np.float32(angle) * _TURN)
    return (
        ca * dx + sa * (c * ax + s * bx), ca * dy + sa * (c * ay + s * by), ca * dz + sa * (c * az + s * bz)
    )  # fmt: skip
