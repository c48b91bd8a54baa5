"""Growth of GEGen: year by year light, sharing, shoots, shedding; at the end wood and leaves."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit
from numba.np.unsafe.ndarray import to_fixed_tuple

from generators.gegen.field import CELLS, WIDE
from generators.gegen.foliage import put_leaves
from generators.gegen.light import cast_shade, gather
from generators.gegen.neighbours import add_still, shade_of_scenery
from generators.gegen.obstacles import World
from generators.gegen.rules import Rule
from generators.gegen.shoots import grow_shoots
from generators.gegen.tree import (
    AGED,
    BASE,
    DEAD,
    DX,
    DZ,
    GATHERED,
    GIVEN,
    HEAD,
    JOINT_FLOATS,
    JOINT_INTS,
    KEPT,
    LAST,
    LEVEL,
    NEXT,
    PARENT,
    START,
    TIP,
    UNITS,
    Tree,
)  # fmt: skip
from generators.gegen.wood import add_pipes, write
from generators.gegen.year import leader_at, share_year
from treefit.plant.compiling import FAST, INNER, ONCE
from treefit.plant.streams import child_key

LEAST_GROWTH = np.float32(0.014)
"""Share of the grown leader; when the growth equation gives less in a year, growth ends."""

_fixed: Any = to_fixed_tuple  # an intrinsic: its first argument is the compiler's
_NUMBERS = len(Rule._fields)
_ZERO, _HALF = np.float32(0.0), np.float32(0.5)


@njit(**FAST)
def grow(told, key, capacity, state, light, shares, scene, numbers, integers, leaves):
    """Grow a plant of at most `capacity` joints; return (vertices, leaves, whether the budget cut it).

    `told` are the numbers of the rule. `numbers` (4, v) takes x, y, z, radius, `integers` (2, v) parent and level,
    `leaves` (11, k) position, axis, normal, size; lengths in internodes.
    """
    rule = Rule(*_fixed(told, _NUMBERS))
    floats, ints, axis_floats, axis_ints, keys = state
    tree = Tree(floats[:capacity], ints[:capacity], axis_floats[:capacity], axis_ints[:capacity], keys[:capacity])
    source, own, still, total, rows, box, taken = light
    boxes, mask, extent, scenery = scene
    world = World(len(boxes) + len(mask) > 0, boxes, mask, extent, taken)
    if rule.markers > 0:
        taken[:] = 0
    own[: box[4] + 1] = _ZERO
    surrounded = shade_of_scenery(rule, scenery, source, own, still, total, rows, box)
    shade = total if surrounded else own
    box[0] = box[2] = WIDE
    box[1] = box[3] = box[4] = 0
    n, axes, scale, year, growing = _begin(rule, tree, key), 1, np.float32(CELLS / rule.leader), 1, True
    while growing:
        cast_shade(rule, tree, n, axes, scale, source, own, rows, box)
        if surrounded:
            add_still(shade, own, still, box)
        bound = np.float32(leader_at(rule, year) - leader_at(rule, year - 1))
        grown = leader_at(rule, year) > rule.leader / 2 and bound < LEAST_GROWTH * rule.leader
        growing = year == 1 or (year <= rule.age and not grown and n < capacity)
        if growing:
            gather(rule, tree, axes, shade, scale, year)
            tree.axis[0, GIVEN] = min(_resource(rule, n, year, bound), np.float32(rule.vigour) * tree.axis[0, GATHERED])
            axes = share_year(rule, tree, axes, year, bound, shares)
            if n == 1:  # a seedling grows in any case
                tree.stem[0, UNITS] = max(tree.stem[0, UNITS], 1)
            n = grow_shoots(rule, tree, n, axes, year, shade, scale, world)
        year += 1
    add_pipes(rule, tree, n)
    k, cut = put_leaves(rule, tree, n, shade, scale, world, leaves)
    vertices, more = write(rule, tree, n, numbers, integers)
    return vertices, k, cut or more or n >= capacity


@njit(**INNER)
def _resource(rule, n, year, bound):
    """Internodes that the tree may grow in a year: what it lacks by now of the square of its crown's height.

    They are at least enough for the leader.
    """
    part = max(leader_at(rule, year) - rule.trunk, 0.0) / max(rule.leader - rule.trunk, 1.0)
    return np.float32(max(rule.internodes * part * part - n, 2.0 * bound))


@njit(**ONCE)
def _begin(rule, tree, key):
    """Make the root with a bud; return the joints."""
    joint, node, axis, stem, keys = tree
    for r in range(JOINT_FLOATS):
        joint[0, r] = _ZERO
    for r in range(JOINT_INTS):
        node[0, r] = 0
    joint[0, DX], joint[0, DZ] = np.float32(math.sin(rule.lean)), np.float32(math.cos(rule.lean))
    node[0, PARENT] = node[0, NEXT] = -1
    stem[0, BASE], stem[0, HEAD], stem[0, TIP] = -1, 0, 0
    stem[0, LEVEL] = stem[0, LAST] = stem[0, START] = stem[0, UNITS] = stem[0, AGED] = stem[0, DEAD] = 0
    keys[0] = child_key(key, 0)
    axis[0, KEPT] = _HALF
    return 1
