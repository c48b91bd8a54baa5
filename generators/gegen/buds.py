"""Lateral buds of GEGen: when they sprout and which way they set out."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.gegen.shoots import AIM, PLACES
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
    UNITS,
)  # fmt: skip
from treefit.plant.compiling import ONCE
from treefit.plant.streams import child_key, circle, two, uniform

START_UNITS = 2
"""Purpose of the draw of a bud: the part of an internode that it has from the start."""
JITTER = np.float32(0.08)
"""Turns of azimuth that are random."""
_ZERO, _ONE, _HALF, _TINY = (np.float32(x) for x in (0.0, 1.0, 0.5, 1e-9))
_TURN = np.float32(1 / (2 * math.pi))


@njit(**ONCE)
def sprout(rule, tree, j, amount, axes, bound, year):
    """Make axes of the lateral buds of a joint that have internodes to grow from `amount`; return the axes."""
    joint, node, axis, stem, key = tree
    a = node[j, AXIS]
    level, buds, first = stem[a, LEVEL], node[j, BUDS], axes
    together = level == 0 and node[j, ORDER] == int(rule.trunk) and rule.forks > 0
    stored = joint[j, STORE] + min(amount / np.float32(buds), bound)
    joint[j, STORE] = stored
    place = child_key(key[a], node[j, ORDER] + PLACES)
    for bud in range(buds):
        own = child_key(place, bud + PLACES)
        grown = stored + uniform(own, START_UNITS)
        units = int(max(grown, _ONE)) if together else int(grown)
        if units == 0 or axes >= len(stem):
            continue
        axis[axes, OUT_X], axis[axes, OUT_Y], axis[axes, OUT_Z] = _lateral(
            rule, tree, j, level, bud, buds, together, own
        )
        axis[axes, KEPT], axis[axes, GIVEN] = max(grown - np.float32(units), _ZERO), _ZERO
        stem[axes, BASE], stem[axes, TIP], stem[axes, HEAD], stem[axes, LEVEL] = j, j, -1, level + 1
        stem[axes, START], stem[axes, UNITS], stem[axes, AGED], stem[axes, DEAD] = year, units, 0, 0
        key[axes] = own
        axes += 1
    if axes > first:
        node[j, FIRST], node[j, LATERALS], node[j, BUDS] = first, axes - first, 0
    return axes


@njit(**ONCE)
def _lateral(rule, tree, j, level, bud, buds, together, key):
    """Direction in which a lateral bud of a joint sets out."""
    joint, node = tree.joint, tree.node
    dx, dy, dz = joint[j, DX], joint[j, DY], joint[j, DZ]
    u, v = two(child_key(key, AIM))
    order = np.float32(node[j, ORDER])
    turn = order * np.float32(rule.phyllotaxis) + np.float32(bud) / np.float32(buds)
    turn += JITTER * (u - _HALF)
    if together:
        angle = rule.fork_angle
    elif level == 0:
        angle = rule.angle + (rule.angle_top - rule.angle) * min(node[j, ORDER] / rule.leader, 1.0)
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
