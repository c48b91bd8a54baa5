"""One year of GEGen: what the root gives goes from axis to axis, and says what every bud shall grow."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.gegen.buds import sprout
from generators.gegen.sharing import share
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
    UNITS,
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
def share_year(rule, tree, axes, year, bound, shares):
    """Share what the root is given among the axes: what each shall grow this year, and new ones; return the axes."""
    joint, node, axis, stem, _ = tree
    places, amounts, order = shares
    trunk = np.float32(math.exp(rule.apical - rule.apical_loss * leader_at(rule, year) / rule.leader))
    branches = np.float32(math.exp(rule.apical_branches))
    short = bound * np.float32(rule.branch_growth)
    for a in range(axes):
        if stem[a, DEAD]:
            continue
        if a > 0 and stem[node[stem[a, BASE], AXIS], DEAD]:
            stem[a, DEAD] = 1
            continue
        given = axis[a, GIVEN]
        if given < LEAST:
            continue
        apical, most = (trunk, bound) if stem[a, LEVEL] == 0 else (branches, short)
        count = share(tree, a, given, apical, np.float32(rule.priority), most, places, amounts, order)
        for item in range(count - 1):
            j = places[item]
            if node[j, LATERALS] > 0:
                each = amounts[item] / joint[j, SIDE]
                for lateral in range(node[j, FIRST], node[j, FIRST] + node[j, LATERALS]):
                    axis[lateral, GIVEN] = each * axis[lateral, GATHERED]
            else:
                axes = sprout(rule, tree, j, amounts[item], axes, short, year)
        if not stem[a, AGED]:
            amount = axis[a, KEPT] + min(amounts[count - 1], most)
            stem[a, UNITS] = int(amount)
            axis[a, KEPT] = amount - np.float32(stem[a, UNITS])
        axis[a, GIVEN] = _ZERO
    return axes
