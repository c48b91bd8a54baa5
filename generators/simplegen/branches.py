"""Growth of SimpleGen's branches between the trunk and the last level: at every joint one child."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.simplegen.chunk import (
    CHUNK,
    DX,
    DY,
    DZ,
    FREE,
    JOINT,
    LONG,
    MADE,
    PICKED,
    RADIUS,
    SPIN,
    X,
    Y,
    Z,
    advance,
    load,
    put_wood,
)  # fmt: skip
from generators.simplegen.crown import kept
from generators.simplegen.directions import aside
from generators.simplegen.rules import CHILD
from treefit.plant.compiling import INNER, ONCE
from treefit.plant.streams import child_key, circle, two

CX, CY, CZ, CHILD_LONG, CHILD_RADIUS, SUM_X, SUM_Y = (FREE + CHUNK * row for row in range(7))
_HALF, _ONE, _TWO, _SPREAD = (np.float32(x) for x in (0.5, 1.0, 2.0, 0.6))


@njit(**ONCE)
def grow_branches(rule, crown, level, stems, n_stems, wood, n, children, floats, keys):
    """Grow the first `n_stems` of `stems` into `wood` from vertex n on, their children into `children`.

    Return (vertices, children, whether the budget cut it).
    """
    m = np.int64(0)  # not a literal: each literal argument would be compiled once more
    for first in range(0, n_stems, CHUNK):
        count = min(CHUNK, n_stems - first)
        load(floats, keys, stems, first, count)
        floats[SUM_X : SUM_X + 2 * CHUNK] = 0
        for i in range(1, int(rule.joints) + 1):
            advance(rule, floats, keys, count, i)
            fitting = min(count, wood.numbers.shape[1] - n)
            put_wood(wood, n, floats, fitting, i, level, count)
            n += fitting
            _children(rule, floats, keys, count, i)
            _keep(rule, crown, floats, count)
            picked = _pick(rule, floats, keys, count)
            if fitting < count or m + picked > len(children.keys):
                return n, m, True
            _append(children, m, floats, keys, picked, n - count)
            m += picked
    return n, m, False


@njit(**INNER)
def _children(rule, floats, keys, count, i):
    """One child at joint `i` of each stem, the last one straight on."""
    t = rule.start + (1.0 - rule.start) * i / rule.joints
    reach, variation = np.float32(rule.length * (1.0 - rule.shortening * t)), np.float32(rule.variation)
    cosine, sine = np.float32(math.cos(rule.angle)), np.float32(math.sin(rule.angle))
    thin = np.float32(rule.radius if i < rule.joints else 1.0)
    straight = i == rule.joints
    for s in range(count):
        twig = child_key(keys[JOINT + s], CHILD)
        keys[MADE + s] = twig
        spread, vary = two(twig)
        floats[CHILD_LONG + s] = floats[LONG + s] * reach * (_ONE + variation * (_TWO * vary - _ONE))
        floats[CHILD_RADIUS + s] = floats[RADIUS + s] * thin
        dx, dy, dz = floats[DX + s], floats[DY + s], floats[DZ + s]
        p, q = circle(floats[SPIN + s] + _SPREAD * (spread - _HALF))
        cx, cy, cz = aside(dx, dy, dz, cosine, sine, p, q, floats[SUM_X + s], floats[SUM_Y + s])
        floats[SUM_X + s] += cx
        floats[SUM_Y + s] += cy
        cx, cy, cz = (dx, dy, dz) if straight else (cx, cy, cz)
        floats[CX + s], floats[CY + s], floats[CZ + s] = cx, cy, cz


@njit(**INNER)
def _keep(rule, crown, floats, count):
    """Shorten the children that leave the crown."""
    bent = np.float32(0.5 * rule.child_upwards)
    for s in range(count):
        x, y, z, long = floats[X + s], floats[Y + s], floats[Z + s], floats[CHILD_LONG + s]
        floats[CHILD_LONG + s] = long * kept(
            crown, x, y, z, floats[CX + s], floats[CY + s], floats[CZ + s] + bent, long
        )


@njit(**INNER)
def _pick(rule, floats, keys, count):
    """List the children that are long enough; return their count."""
    picked, shortest = 0, np.float32(rule.shortest)
    for s in range(count):
        keys[PICKED + picked] = s
        picked += floats[CHILD_LONG + s] >= shortest
    return picked


@njit(**INNER)
def _append(children, m, floats, keys, picked, first_vertex):
    """Put the children that were picked behind the first `m`; their joints are the vertices from `first_vertex` on."""
    fields = children.fields
    for k in range(picked):
        s, to = keys[PICKED + k], np.uint64(m + k)
        fields[0, to], fields[1, to], fields[2, to] = floats[X + s], floats[Y + s], floats[Z + s]
        fields[3, to], fields[4, to], fields[5, to] = floats[CX + s], floats[CY + s], floats[CZ + s]
        fields[6, to], fields[7, to] = floats[CHILD_LONG + s], floats[CHILD_RADIUS + s]
        fields[8, to] = np.float32(first_vertex + s)
        children.keys[to] = keys[MADE + s]
