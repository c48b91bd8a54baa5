"""One year of GEGen: what the root gives goes from axis to axis, and every bud grows what it got."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.gegen.buds import sprout
from generators.gegen.sharing import share
from generators.gegen.shoots import extend
from generators.gegen.tree import (
    AGED,
    AXIS,
    BASE,
    DEAD,
    FIRST,
    GATHERED,
    GIVEN,
    KEPT,
    LATERALS,
    LEVEL,
    SIDE,
)  # fmt: skip
from treefit.plant.compiling import INNER, ONCE

LEAST = np.float32(0.02)
"""Internodes a year of which an axis makes nothing."""
_ZERO = np.float32(0.0)


@njit(**INNER)
def leader_at(rule, year):
    """Length of the leader in internodes after `year` years: the growth equation, logistic."""
    return rule.leader / (1.0 + (rule.leader / rule.start - 1.0) * math.exp(-rule.rate * year))


@njit(**ONCE)
def grow_year(rule, tree, n, axes, year, bound, shade, scale, lists, world):
    """Share what the root is given among the axes and grow their buds; return (joints, axes)."""
    joint, node, axis, stem, _ = tree
    places, amounts, order = lists
    old = axes
    trunk = np.float32(math.exp(rule.apical - rule.apical_loss * leader_at(rule, year) / rule.leader))
    branches = np.float32(math.exp(rule.apical_branches))
    short = bound * np.float32(rule.branch_growth)
    for a in range(old):
        if stem[DEAD, a]:
            continue
        if a > 0 and stem[DEAD, node[AXIS, stem[BASE, a]]]:
            stem[DEAD, a] = 1
            continue
        given = axis[GIVEN, a]
        if given < LEAST:
            continue
        apical, most = (trunk, bound) if stem[LEVEL, a] == 0 else (branches, short)
        count = share(tree, a, given, apical, np.float32(rule.priority), most, places, amounts, order)
        for item in range(count - 1):
            j = places[item]
            if node[LATERALS, j] > 0:
                each = amounts[item] / joint[SIDE, j]
                for lateral in range(node[FIRST, j], node[FIRST, j] + node[LATERALS, j]):
                    axis[GIVEN, lateral] = each * axis[GATHERED, lateral]
            else:
                n, axes = sprout(rule, tree, j, amounts[item], n, axes, short, year, shade, scale, world)
        if not stem[AGED, a]:
            amount = axis[KEPT, a] + min(amounts[count - 1], most)
            units = int(amount)
            axis[KEPT, a] = amount - np.float32(units)
            n = extend(rule, tree, a, n, units, year, shade, scale, world)
        axis[GIVEN, a] = _ZERO
        if n >= joint.shape[1]:
            break
    return n, axes
