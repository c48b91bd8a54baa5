"""Sharing: what an axis is given goes to its buds and branches (extended Borchert-Honda, then a list by priority)."""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.gegen.tree import HEAD, MAIN, NEXT, SIDE
from treefit.plant.compiling import INNER, ONCE

LEAST_WEIGHT = np.float32(0.03)
"""Of the last in the list."""
_ZERO, _ONE = np.float32(0.0), np.float32(1.0)


@njit(**ONCE)
def share(tree, a, given, apical, priority, bound, places, amounts, order):
    """Share `given` among the joints of axis `a` that have something to their side, and its tip; return their count.

    `places` and `amounts` take the joints and what is for their side; the last is for the tip. The sum of the
    amounts is `given`. `apical` is lambda / (1 - lambda).
    """
    joint, node, _, stem, _ = tree
    count, rest, j = 0, given, stem[a, HEAD]
    while j >= 0:
        main, side = joint[j, MAIN], joint[j, SIDE]
        if side > _ZERO:
            lateral = rest * side / (apical * main + side)
            places[count], amounts[count] = j, lateral
            rest -= lateral
            count += 1
        j = node[j, NEXT]
    amounts[count] = max(rest, _ZERO)
    count += 1
    if priority > 0 and count > 1:
        _by_priority(given, priority, amounts, order, count)
    tip = amounts[count - 1]
    others = _ZERO
    for i in range(count - 1):
        others += amounts[i]
    if tip > bound and others > _ZERO:
        more = (given - bound) / others
        for i in range(count - 1):
            amounts[i] *= more
        amounts[count - 1] = bound
    return count


@njit(**INNER)
def _by_priority(given, step, amounts, order, count):
    """Weigh the amounts by their place in the list of the largest first; their sum stays."""
    for i in range(count):
        place = i
        while place > 0 and amounts[order[place - 1]] < amounts[i]:
            order[place] = order[place - 1]
            place -= 1
        order[place] = i
    total, weight = _ZERO, _ONE
    for place in range(count):
        amounts[order[place]] *= weight
        total += amounts[order[place]]
        weight = max(weight - step, LEAST_WEIGHT)
    if total > _ZERO:
        for i in range(count):
            amounts[i] *= given / total
