"""Shoots: what a bud grows in one year, internode by internode."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.gegen.markers import MARKER, take, towards_marker
from generators.gegen.obstacles import GROUND, around
from generators.gegen.space import sphere, towards_light
from generators.gegen.tree import (
    AGED,
    AXIS,
    BASE,
    BORN,
    BUDS,
    DEAD,
    DX,
    DY,
    DZ,
    HEAD,
    LAST,
    LATERALS,
    LEVEL,
    NEXT,
    ORDER,
    OUT_X,
    OUT_Y,
    OUT_Z,
    PARENT,
    PATH,
    STORE,
    TIP,
    UNITS,
    WEIGHT,
    X,
    Y,
    Z,
)  # fmt: skip
from treefit.plant.compiling import ONCE
from treefit.plant.streams import child_key, circle, two, uniform

FIRMNESS = np.float32(3.0)
"""Weight of the direction in which a new branch sets out."""
SPROUT, AIM, LUCK, PLACES = 3, 4, 5, 8
"""Purposes of draws; joints and their buds are keyed from PLACES on."""
SPAN = np.float32(math.sqrt(12))
"""Width of an even distribution of deviation 1."""
_ZERO, _ONE, _HALF, _TINY = (np.float32(x) for x in (0.0, 1.0, 0.5, 1e-9))
_TURN = np.float32(1 / (2 * math.pi))


@njit(**ONCE)
def grow_shoots(rule, tree, n, axes, year, shade, scale, world):
    """Grow the internodes that every axis shall grow this year, fewer where there is no way; return the joints.

    A new axis that finds no way is dead.
    """
    node, stem, key = tree.node, tree.stem, tree.key
    for a in range(axes):
        units, before, base, level = stem[a, UNITS], n, stem[a, BASE], stem[a, LEVEL]
        stem[a, UNITS] = 0
        for i in range(min(units, len(tree.joint) - n)):
            j = stem[a, TIP]
            order = 0 if j == base else node[j, ORDER] + 1
            own = child_key(key[a], order + PLACES)
            free, dx, dy, dz = _way(rule, tree, a, j, order, own, shade, scale, world)
            if not free:
                break
            node[n, PARENT], node[n, AXIS], node[n, NEXT], node[n, LATERALS] = j, a, -1, 0
            node[n, BORN], node[n, ORDER] = year, order
            node[n, PATH] = 0 if level == 0 else node[j, PATH] + 1
            node[n, BUDS] = _lateral_buds(rule, level, order, own)
            _put_joint(rule, tree, j, n, dx, dy, dz, np.float32(i + 1) / np.float32(units), own)
            if rule.markers > 0:
                take(world.taken, child_key(key[0], MARKER), tree.joint[n, X], tree.joint[n, Y], tree.joint[n, Z])
            if j == base:
                stem[a, HEAD] = n
            else:
                node[j, NEXT] = n
            stem[a, TIP] = n
            n += 1
        if n > before:
            stem[a, LAST] = year
        elif stem[a, HEAD] < 0:
            stem[a, DEAD] = 1
    return n


@njit(**ONCE)
def _way(rule, tree, a, j, order, own, shade, scale, world):
    """Way of the next internode of an axis: whether there is one, and its direction.

    Direction so far + mu * way to the best-lit point + tropism ([Yi15]; Palubicki et al. 2009, sec. 4.4).
    """
    joint, node, axis, stem, key = tree
    level, first = stem[a, LEVEL], j == stem[a, BASE]
    x, y, z = joint[j, X], joint[j, Y], joint[j, Z]
    unit, firm = np.float32(_ONE / rule.leader), _ONE
    if level == 0 and order <= rule.trunk:  # the template
        turn = np.float32(rule.lean + rule.bend * order / max(rule.trunk, 1.0)) * _TURN
        dz, dx = circle(turn)
        dy = _ZERO
    else:
        dx, dy, dz = joint[j, DX], joint[j, DY], joint[j, DZ]
        pull = np.float32(rule.tropism_trunk)
        if level > 0:
            pull = np.float32(rule.tropism + rule.tropism_change * (node[j, PATH] / rule.leader))
            if first:
                firm, dx, dy, dz = FIRMNESS, axis[a, OUT_X], axis[a, OUT_Y], axis[a, OUT_Z]
        if rule.markers > 0:
            lx, ly, lz = towards_marker(
                world.taken, shade, x, y, z, dx, dy, dz, scale, child_key(key[0], MARKER)
            )  # fmt: skip
            if lx == 0 and ly == 0 and lz == 0:
                return False, dx, dy, dz
        else:
            lx, ly, lz = towards_light(shade, x, y, z, scale, own)
        rx, ry, rz = sphere(*two(child_key(own, AIM)))
        mu, wobble = np.float32(rule.light_seeking), np.float32(rule.wobble)
        up = max(pull, _ZERO)  # what rises, rises to the light; what hangs, hangs straight down
        dx = firm * dx + mu * lx + wobble * rx + up * np.float32(rule.light_x)
        dy = firm * dy + mu * ly + wobble * ry + up * np.float32(rule.light_y)
        dz = firm * dz + mu * lz + wobble * rz + pull
    inverse = _ONE / math.sqrt(dx * dx + dy * dy + dz * dz + _TINY)
    dx, dy, dz = dx * inverse, dy * inverse, dz * inverse
    if dz < 0 and z + dz < GROUND:
        stem[a, AGED] = 1
        return False, dx, dy, dz
    if world.solid:
        free, dx, dy, dz = around(world, x, y, z, dx, dy, dz, unit)
        if not free:
            stem[a, AGED] = 1
            return False, dx, dy, dz
    return True, dx, dy, dz


@njit(**ONCE)
def _put_joint(rule, tree, j, n, dx, dy, dz, share, own):
    """Put joint `n` after joint `j`; `share` is its place on the shoot of this year, from base to tip."""
    joint = tree.joint
    joint[n, X], joint[n, Y], joint[n, Z] = joint[j, X] + dx, joint[j, Y] + dy, joint[j, Z] + dz
    joint[n, DX], joint[n, DY], joint[n, DZ], joint[n, STORE] = dx, dy, dz, _ZERO
    weight = _ONE - np.float32(rule.acrotony) * (_ONE - share * share)
    joint[n, WEIGHT] = weight * math.exp(np.float32(rule.variation) * SPAN * (uniform(own, LUCK) - _HALF))


@njit(**ONCE)
def _lateral_buds(rule, level, order, key):
    """Lateral buds of a joint: none on the bare trunk, the first branches at its top."""
    if level + 1 >= rule.levels:
        return 0
    if level == 0 and order < rule.trunk:
        return 0
    if level == 0 and order == int(rule.trunk) and rule.forks > 0:
        return int(rule.forks)
    if uniform(key, SPROUT) >= rule.bud_share:
        return 0
    return int(rule.whorl) if level == 0 else 1
