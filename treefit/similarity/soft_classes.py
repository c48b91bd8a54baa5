"""Soft agreement of the classes: their pixels counted in windows of several sizes, so that near misses count."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass as checked

from treefit.view.frame import BitMask

SCALES = 3
"""Windows of an eighth, a 16th and a 32nd of the height, where the resolution is a power of two."""


_FIELDS = np.array(
    [0x5555555555555555, 0x3333333333333333, 0x0F0F0F0F0F0F0F0F, 0x00FF00FF00FF00FF, 0x0000FFFF0000FFFF], np.uint64
)  # every other field of a word, by which neighbours are added to fields twice as wide


@dataclass(frozen=True, eq=False)
class Windows:
    """Pixels a window at half-window steps, smallest windows first; `foliage` and `branch` (r, c) uint16 a scale."""

    foliage: tuple[NDArray[np.uint16], ...]
    branch: tuple[NDArray[np.uint16], ...]
    has_branch: bool


@checked(frozen=True, config=ConfigDict(extra="forbid"))
class SoftClasses:
    """Mean over scales of sum(min f + w min b) / sum(max f + w max b).

    f and b are the counts of foliage and branch pixels in a window of the target and of the plant; w is
    `branch_weight`, for branches are few, and 1 for a target without any.
    """

    branch_weight: float = Field(default=3.0, gt=0, le=100)

    def describe(self, bits: BitMask) -> Windows:
        """Counts of both classes in the windows of every scale."""
        cell = smallest_cell(bits.branch.shape[0])
        foliage, branch = windows(bits.foliage, cell), windows(bits.branch, cell)
        return Windows(foliage, branch, bool(branch[-1].any()))

    def compare(self, target: Windows, plant: Windows) -> float:
        """Agreement in [0, 1], 1 for the same counts."""
        weight = self.branch_weight if target.has_branch else 1.0
        return float(agreement(target.foliage, target.branch, plant.foliage, plant.branch, weight))


def smallest_cell(height: int) -> int:
    """Half of the smallest window in pixels: the power of two at or under a 64th of the height, 1 at least."""
    cell = 1
    while cell * 128 <= height:
        cell *= 2
    return cell


def windows(bits: NDArray[np.uint64], cell: int) -> tuple[NDArray[np.uint16], ...]:
    """Counts of set bits in windows of 2, 4 and 8 cells, at half-window steps, from bit rows (height, words)."""
    height, words = bits.shape
    cells = np.zeros((-(-height // cell), words * 64 // cell), np.uint16)
    count_cells(bits, cell, cells)
    found = []
    for _ in range(SCALES):
        window = np.empty((cells.shape[0] - 1, cells.shape[1] - 1), np.uint16)
        coarser = np.empty(((cells.shape[0] + 1) // 2, cells.shape[1] // 2), np.uint16)
        join_cells(cells, window, coarser)
        found.append(window)
        cells = coarser
    return tuple(found)


@njit(cache=True, nogil=True)
def count_cells(bits, cell, cells):
    """Add up the set bits of squares of `cell` pixels (a power of two up to 32) into `cells`."""
    height, words = bits.shape
    across, lowest = 64 // cell, np.uint64((1 << cell) - 1)
    for row in range(height):
        sums = cells[row // cell]
        for word in range(words):
            x = bits[row, word]
            if x == np.uint64(0):
                continue
            width = 1
            for every in _FIELDS:
                if width == cell:
                    break
                x = (x & every) + ((x >> np.uint64(width)) & every)
                width *= 2
            for k in range(across):
                sums[word * across + k] += np.uint16((x >> np.uint64(k * cell)) & lowest)


@njit(cache=True, nogil=True)
def join_cells(cells, window, coarser):
    """Sums of 2 x 2 cells: at every cell into `window`, at every other one into `coarser`."""
    for row in range(window.shape[0]):
        upper, lower, sums = cells[row], cells[row + 1], window[row]
        for column in range(len(sums)):
            sums[column] = upper[column] + upper[column + 1] + lower[column] + lower[column + 1]
    for row in range(coarser.shape[0]):
        for column in range(coarser.shape[1]):
            total = cells[2 * row, 2 * column] + cells[2 * row, 2 * column + 1]
            if 2 * row + 1 < cells.shape[0]:
                total += cells[2 * row + 1, 2 * column] + cells[2 * row + 1, 2 * column + 1]
            coarser[row, column] = total


@njit(cache=True, nogil=True)
def agreement(foliage1, branch1, foliage2, branch2, weight):
    """Mean over the scales of the shared counts by the joined counts."""
    total = 0.0
    for scale in range(len(foliage1)):
        f_low, f_high = _shared(foliage1[scale], foliage2[scale])
        b_low, b_high = _shared(branch1[scale], branch2[scale])
        high = f_high + weight * b_high
        total += (f_low + weight * b_low) / high if high > 0 else 1.0
    return total / len(foliage1)


@njit(cache=True, nogil=True)
def _shared(one, two):
    """Sums of the smaller and of the larger counts."""
    low, high = 0, 0
    for row in range(one.shape[0]):
        a, b = one[row], two[row]
        row_low, row_high = np.uint32(0), np.uint32(0)
        for column in range(len(a)):
            row_low += np.uint32(min(a[column], b[column]))
            row_high += np.uint32(max(a[column], b[column]))
        low += int(row_low)
        high += int(row_high)
    return low, high
