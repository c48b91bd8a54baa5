"""Overlap of the classes, pixel by pixel."""

from __future__ import annotations

import numpy as np
from numba import njit
from pydantic import ConfigDict
from pydantic.dataclasses import dataclass

from treefit.similarity.bits import popcount
from treefit.view.frame import BitMask


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class ClassOverlap:
    """Mean of intersection by union over the classes of the target, of background, branch and foliage."""

    def describe(self, bits: BitMask) -> BitMask:
        """The mask itself."""
        return bits

    def compare(self, target: BitMask, plant: BitMask) -> float:
        """Mean overlap in [0, 1], 1 for the same mask."""
        return float(overlap(target.branch, target.foliage, plant.branch, plant.foliage))


@njit(cache=True, nogil=True)
def overlap(branch1, foliage1, branch2, foliage2):
    """Mean intersection by union of the classes that the first mask has, from bit rows (height, words)."""
    wood = wood_all = leaves = leaves_all = empty = empty_all = 0
    has_wood = has_leaves = has_empty = np.uint64(0)
    for row in range(branch1.shape[0]):
        for word in range(branch1.shape[1]):
            b1, f1, b2, f2 = branch1[row, word], foliage1[row, word], branch2[row, word], foliage2[row, word]
            wood += popcount(b1 & b2)
            wood_all += popcount(b1 | b2)
            leaves += popcount(f1 & f2)
            leaves_all += popcount(f1 | f2)
            empty += popcount(~(b1 | f1 | b2 | f2))
            empty_all += popcount(~((b1 | f1) & (b2 | f2)))
            has_wood |= b1
            has_leaves |= f1
            has_empty |= ~(b1 | f1)
    total, count = 0.0, 0
    for there, shared, joined in (
        (has_wood, wood, wood_all),
        (has_leaves, leaves, leaves_all),
        (has_empty, empty, empty_all),
    ):
        if there:
            total += shared / joined
            count += 1
    return total / count
