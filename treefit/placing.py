"""Placing: where a tree stands in a mask, so that masks and pictures are laid over each other by it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from treefit.mask import BRANCH, Mask


@dataclass(frozen=True)
class Placing:
    """Where a tree stands in a mask: rows top..bottom (exclusive) and the column of its trunk base, in pixels."""

    top: int
    bottom: int
    base: float
    left: int
    right: int

    @property
    def reach(self) -> float:
        """Farthest content from the trunk base, in tree heights."""
        return max(self.base - self.left, self.right - self.base) / (self.bottom - self.top)

    @property
    def width(self) -> float:
        """Width of the content in tree heights."""
        return (self.right - self.left) / (self.bottom - self.top)


def place(mask: Mask) -> Placing:
    """Find the tree in a mask (h, w); ValueError when the mask is empty."""
    rows = np.flatnonzero(mask.any(axis=1))
    if len(rows) == 0:
        raise ValueError("mask: no tree in it, all pixels are background")
    columns = np.flatnonzero(mask.any(axis=0))
    top, bottom = int(rows[0]), int(rows[-1]) + 1
    lowest = mask[bottom - 1 - (bottom - top) // 50 : bottom] == BRANCH
    counted = lowest if lowest.any() else mask > 0
    base = float(np.average(np.arange(mask.shape[1]) + 0.5, weights=counted.sum(axis=0)))
    return Placing(top, bottom, base, int(columns[0]), int(columns[-1]) + 1)
