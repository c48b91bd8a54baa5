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
    WEIGHT,
    X,
    Y,
    Z,
)  # fmt: skip
from treefit.plant.compiling import INNER
from treefit.plant.streams import child_key, circle, two, uniform

FIRMNESS = np.float32(3.0)
"""Weight of the direction in which a new branch sets out."""
SPROUT, AIM, LUCK, PLACES = 3, 4, 5, 8
"""Purposes of draws; joints and their buds are keyed from PLACES on."""
SPAN = np.float32(math.sqrt(12))
"""Width of an even distribution of deviation 1."""
_ZERO, _ONE, _HALF, _TINY = (np.float32(x) for x in (0.0, 1.0, 0.5, 1e-9))
_TURN = np.float32(1 / (2 * math.pi))


@njit(**INNER)
def extend(rule, tree, a, n, count, year, shade, scale, world):
    """Grow `count` internodes at the tip of axis `a`, fewer where there is no way; return the joints of the tree."""
    node, stem, key = tree.node, tree.stem, tree.key
    base, level, before = stem[BASE, a], stem[LEVEL, a], n
    for i in range(min(count, tree.joint.shape[1] - n)):
        j = stem[TIP, a]
        order = 0 if j == base else node[ORDER, j] + 1
        own = child_key(key[a], order + PLACES)
        free, dx, dy, dz = _way(rule, tree, a, j, order, own, shade, scale, world)
        if not free:
            break
        node[PARENT, n], node[AXIS, n], node[NEXT, n], node[LATERALS, n] = j, a, -1, 0
        node[BORN, n], node[ORDER, n] = year, order
        node[PATH, n] = 0 if level == 0 else node[PATH, j] + 1
        node[BUDS, n] = lateral_buds(rule, level, order, own)
        _put_joint(rule, tree, j, n, dx, dy, dz, np.float32(i + 1) / np.float32(count), own)
        if rule.markers > 0:
            take(world.taken, child_key(key[0], MARKER), tree.joint[X, n], tree.joint[Y, n], tree.joint[Z, n])
        if j == base:
            stem[HEAD, a] = n
        else:
            node[NEXT, j] = n
        stem[TIP, a] = n
        n += 1
    if n > before:
        stem[LAST, a] = year
    return n


@njit(**INNER)
def _way(rule, tree, a, j, order, own, shade, scale, world):
    """Way of the next internode of an axis: whether there is one, and its direction.

    Direction so far + mu * way to the best-lit point + tropism ([Yi15]; Palubicki et al. 2009, sec. 4.4).
    """
    joint, node, axis, stem, key = tree
    level, first = stem[LEVEL, a], j == stem[BASE, a]
    x, y, z = joint[X, j], joint[Y, j], joint[Z, j]
    unit, firm = np.float32(_ONE / rule.height), _ONE
    if level == 0 and order <= rule.trunk:  # the template
        turn = np.float32(rule.lean + rule.bend * order / max(rule.trunk, 1.0)) * _TURN
        dz, dx = circle(turn)
        dy = _ZERO
    else:
        dx, dy, dz = joint[DX, j], joint[DY, j], joint[DZ, j]
        pull = np.float32(rule.tropism_trunk)
        if level > 0:
            pull = np.float32(rule.tropism + rule.tropism_change * (node[PATH, j] / rule.height))
            if first:
                firm, dx, dy, dz = FIRMNESS, axis[OUT_X, a], axis[OUT_Y, a], axis[OUT_Z, a]
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
        dx, dy, dz = (
            firm * dx + mu * lx + wobble * rx, firm * dy + mu * ly + wobble * ry,
            firm * dz + mu * lz + wobble * rz + pull,
        )  # fmt: skip
    dx, dy, dz = _over_ground(z, dx, dy, dz)
    if world.solid:
        free, dx, dy, dz = around(world, x, y, z, dx, dy, dz, unit)
        if not free:
            stem[AGED, a] = 1
            return False, dx, dy, dz
    return True, dx, dy, dz


@njit(**INNER)
def _over_ground(z, dx, dy, dz):
    """Unit direction, level enough to stay over the ground."""
    inverse = _ONE / math.sqrt(dx * dx + dy * dy + dz * dz + _TINY)
    dx, dy, dz = dx * inverse, dy * inverse, dz * inverse
    if dz < 0 and z + dz < GROUND:
        dx, dz = dx + np.float32(1e-4), GROUND - z
        flat = math.sqrt((_ONE - dz * dz) / (dx * dx + dy * dy))
        dx, dy = dx * flat, dy * flat
    return dx, dy, dz


@njit(**INNER)
def _put_joint(rule, tree, j, n, dx, dy, dz, share, own):
    """Put joint `n` after joint `j`; `share` is its place on the shoot of this year, from base to tip."""
    joint = tree.joint
    joint[X, n], joint[Y, n], joint[Z, n] = joint[X, j] + dx, joint[Y, j] + dy, joint[Z, j] + dz
    joint[DX, n], joint[DY, n], joint[DZ, n], joint[STORE, n] = dx, dy, dz, _ZERO
    weight = _ONE - np.float32(rule.acrotony) * (_ONE - share * share)
    joint[WEIGHT, n] = weight * math.exp(np.float32(rule.variation) * SPAN * (uniform(own, LUCK) - _HALF))


@njit(**INNER)
def lateral_buds(rule, level, order, key):
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
