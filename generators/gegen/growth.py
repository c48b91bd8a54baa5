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
from generators.gegen.shoots import extend
from generators.gegen.tree import (
    AGED,
    BASE,
    DEAD,
    DX,
    DZ,
    GATHERED,
    GIVEN,
    HEAD,
    KEPT,
    LAST,
    LEVEL,
    NEXT,
    PARENT,
    START,
    TIP,
    Tree,
)  # fmt: skip
from generators.gegen.wood import add_pipes, bury, write
from generators.gegen.year import grow_year, leader_at
from treefit.plant.compiling import FAST, INNER, ONCE
from treefit.plant.streams import child_key

LEAST_BOUND = np.float32(0.5)
"""Internodes a year at which the growth equation ends the growth."""

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
    tree = Tree(
        floats[:, :capacity], ints[:, :capacity], axis_floats[:, :capacity], axis_ints[:, :capacity], keys[:capacity]
    )
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
    n, axes, scale, year, growing = _begin(rule, tree, key), 1, np.float32(CELLS / rule.height), 1, True
    while growing:
        cast_shade(rule, tree, n, scale, source, own, rows, box)
        if surrounded:
            add_still(shade, own, still, box)
        bound = np.float32(leader_at(rule, year) - leader_at(rule, year - 1))
        grown = leader_at(rule, year) > rule.leader / 2 and bound < LEAST_BOUND
        growing = year <= rule.age and not grown and n < capacity
        if growing:
            gather(rule, tree, axes, shade, scale, year)
            tree.axis[GIVEN, 0] = min(_resource(rule, year), np.float32(rule.vigour) * tree.axis[GATHERED, 0])
            n, axes = grow_year(rule, tree, n, axes, year, bound, shade, scale, shares, world)
        year += 1
    if n == 1:  # what found nothing to grow from is a seedling
        n = extend(rule, tree, 0, n, 1, 1, shade, scale, world)
    bury(tree, axes)
    add_pipes(rule, tree, n)
    k, cut = put_leaves(rule, tree, n, shade, scale, world, leaves)
    vertices, more = write(rule, tree, n, numbers, integers)
    return vertices, k, cut or more or n >= capacity


@njit(**INNER)
def _resource(rule, year):
    """Internodes that the whole tree may grow in a year: the crown grows as the square of its height."""
    crown = max(rule.leader - rule.trunk, 1.0)
    after, before = leader_at(rule, year), leader_at(rule, year - 1)
    part, earlier = max(after - rule.trunk, 0.0) / crown, max(before - rule.trunk, 0.0) / crown
    return np.float32(max(rule.internodes * (part * part - earlier * earlier), 2.0 * (after - before)))


@njit(**ONCE)
def _begin(rule, tree, key):
    """Make the root with a bud; return the joints."""
    joint, node, axis, stem, keys = tree
    for r in range(len(joint)):
        joint[r, 0] = _ZERO
    for r in range(len(node)):
        node[r, 0] = 0
    joint[DX, 0], joint[DZ, 0] = np.float32(math.sin(rule.lean)), np.float32(math.cos(rule.lean))
    node[PARENT, 0] = node[NEXT, 0] = -1
    stem[BASE, 0], stem[HEAD, 0], stem[TIP, 0] = -1, 0, 0
    stem[LEVEL, 0] = stem[LAST, 0] = stem[START, 0] = stem[AGED, 0] = stem[DEAD, 0] = 0
    keys[0] = child_key(key, 0)
    axis[KEPT, 0] = _HALF
    return 1
