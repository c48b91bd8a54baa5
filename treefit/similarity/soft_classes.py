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
"""Windows of a 32nd, a 16th and an eighth of the height, where the resolution is a power of two."""
_FIELDS = np.array(
    [0x5555555555555555, 0x3333333333333333, 0x0F0F0F0F0F0F0F0F, 0x00FF00FF00FF00FF, 0x0000FFFF0000FFFF], np.uint64
)  # every other field of a word, by which neighbours are added to fields twice as wide
_PAIRS, _FOURS = np.uint64(0x5555555555555555), np.uint64(0x3333333333333333)
_1, _2, _15 = np.uint64(1), np.uint64(2), np.uint64(15)


@dataclass(frozen=True, eq=False)
class Windows:
    """Pixels of foliage and of branch in windows at half-window steps (2, n) uint16, scale after scale."""

    counts: NDArray[np.uint16]
    ends: tuple[int, ...]  # (SCALES,), behind the last window of each scale
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
        height, words = bits.branch.shape
        cell = smallest_cell(height)
        rows, columns = -(-height // cell), words * 64 // cell
        ends, n = [], 0
        for scale in range(SCALES):
            n += (-(-rows >> scale) - 1) * ((columns >> scale) - 1)
            ends.append(n)
        counts, cells = np.empty((2, n), np.uint16), np.empty(2 * (rows + 1) * columns, np.uint16)
        has_branch = count_windows(bits.foliage, bits.branch, cell, counts, cells)
        return Windows(counts, tuple(ends), has_branch)

    def compare(self, target: Windows, plant: Windows) -> float:
        """Agreement in [0, 1], 1 for the same counts."""
        weight = self.branch_weight if target.has_branch else 1.0
        return float(agreement(target.counts, plant.counts, target.ends, weight))


def smallest_cell(height: int) -> int:
    """Half of the smallest window in pixels: the power of two at or under a 64th of the height, 1 at least."""
    cell = 1
    while cell * 128 <= height:
        cell *= 2
    return cell


@njit(cache=True, nogil=True)
def count_windows(foliage, branch, cell, counts, memory):
    """Fill `counts`; `memory` holds the cells. Return whether there is any branch."""
    any_branch = False
    for label in range(2):
        bits = foliage if label == 0 else branch
        rows, columns, n = (bits.shape[0] + cell - 1) // cell, bits.shape[1] * 64 // cell, 0
        cells = memory[: rows * columns].reshape(rows, columns)
        filled = _count_pairs(bits, cells) if cell == 2 and bits.shape[0] % 2 == 0 else _count_cells(bits, cell, cells)
        any_branch |= label == 1 and filled
        for _ in range(SCALES):
            _join_windows(cells, counts[label, n : n + (rows - 1) * (columns - 1)])
            n += (rows - 1) * (columns - 1)
            rows, columns = (rows + 1) // 2, columns // 2
            coarser = memory[len(memory) - rows * columns :].reshape(rows, columns)
            _join_cells(cells, coarser)
            cells = memory[: rows * columns].reshape(rows, columns)
            cells[:] = coarser
    return any_branch


@njit
def _count_pairs(bits, cells):
    """Count the set bits of squares of 2 pixels, two rows at once; return whether there are any."""
    joined = np.uint64(0)
    for row in range(cells.shape[0]):
        upper, lower, sums = bits[2 * row], bits[2 * row + 1], cells[row]
        for word in range(len(upper)):
            a, b, at = upper[word], lower[word], word * 32
            joined |= a | b
            a, b = (a & _PAIRS) + ((a >> _1) & _PAIRS), (b & _PAIRS) + ((b >> _1) & _PAIRS)
            even, odd = (a & _FOURS) + (b & _FOURS), ((a >> _2) & _FOURS) + ((b >> _2) & _FOURS)
            for k in range(16):
                sums[at + 2 * k] = (even >> np.uint64(4 * k)) & _15
                sums[at + 2 * k + 1] = (odd >> np.uint64(4 * k)) & _15
    return joined != np.uint64(0)


@njit
def _count_cells(bits, cell, cells):
    """Count the set bits of squares of `cell` pixels, a power of two up to 32; return whether there are any."""
    height, words = bits.shape
    across, lowest, joined = 64 // cell, np.uint64((1 << cell) - 1), np.uint64(0)
    cells[:] = 0
    for row in range(height):
        sums = cells[row // cell]
        for word in range(words):
            x = bits[row, word]
            joined |= x
            width = 1
            for every in _FIELDS:
                if width == cell:
                    break
                x = (x & every) + ((x >> np.uint64(width)) & every)
                width *= 2
            for k in range(across):
                sums[word * across + k] += np.uint16((x >> np.uint64(k * cell)) & lowest)
    return joined != np.uint64(0)


@njit
def _join_windows(cells, window):
    """Sums of 2 x 2 cells at every cell."""
    columns = cells.shape[1] - 1
    for row in range(cells.shape[0] - 1):
        upper, lower, sums = cells[row], cells[row + 1], window[row * columns : (row + 1) * columns]
        for column in range(columns):
            sums[column] = upper[column] + upper[column + 1] + lower[column] + lower[column + 1]


@njit
def _join_cells(cells, coarser):
    """Sums of 2 x 2 cells at every other one; rows behind the last are empty."""
    for row in range(coarser.shape[0]):
        upper, sums = cells[2 * row], coarser[row]
        for column in range(len(sums)):
            sums[column] = upper[2 * column] + upper[2 * column + 1]
        if 2 * row + 1 < cells.shape[0]:
            lower = cells[2 * row + 1]
            for column in range(len(sums)):
                sums[column] += lower[2 * column] + lower[2 * column + 1]


@njit(cache=True, nogil=True)
def agreement(one, two, ends, weight):
    """Mean over the scales of the shared counts by the joined counts."""
    total, first = 0.0, 0
    for end in ends:
        f_low, f_high = _shared(one[0, first:end], two[0, first:end])
        b_low, b_high = _shared(one[1, first:end], two[1, first:end])
        high = f_high + weight * b_high
        total += (f_low + weight * b_low) / high if high > 0 else 1.0
        first = end
    return total / len(ends)


@njit
def _shared(one, two):
    """Sums of the smaller and of the larger counts."""
    low, high = np.uint32(0), np.uint32(0)
    for i in range(len(one)):
        a, b = np.uint32(one[i]), np.uint32(two[i])
        low += min(a, b)
        high += max(a, b)
    return float(low), float(high)
