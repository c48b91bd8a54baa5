"""Overlap of the classes, pixel by pixel."""

from __future__ import annotations

from numba import njit
from pydantic import ConfigDict
from pydantic.dataclasses import dataclass

from treefit.similarity.bits import popcount
from treefit.view.frame import BitMask


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class ClassOverlap:
    """Mean over background, branch and foliage of intersection by union; a class in neither mask does not count."""

    def describe(self, bits: BitMask) -> BitMask:
        """The mask itself."""
        return bits

    def compare(self, target: BitMask, plant: BitMask) -> float:
        """Mean overlap in [0, 1], 1 for the same mask."""
        return float(overlap(target.branch, target.foliage, plant.branch, plant.foliage))


@njit(cache=True, nogil=True)
def overlap(branch1, foliage1, branch2, foliage2):
    """Mean intersection by union of the classes in bit rows (height, words)."""
    wood = wood_all = leaves = leaves_all = empty = empty_all = 0
    for row in range(branch1.shape[0]):
        for word in range(branch1.shape[1]):
            b1, f1, b2, f2 = branch1[row, word], foliage1[row, word], branch2[row, word], foliage2[row, word]
            wood += popcount(b1 & b2)
            wood_all += popcount(b1 | b2)
            leaves += popcount(f1 & f2)
            leaves_all += popcount(f1 | f2)
            empty += popcount(~(b1 | f1 | b2 | f2))
            empty_all += popcount(~((b1 | f1) & (b2 | f2)))
    total, count = 0.0, 0
    for shared, joined in ((wood, wood_all), (leaves, leaves_all), (empty, empty_all)):
        if joined > 0:
            total += shared / joined
            count += 1
    return total / count
