"""Soft agreement of the classes: their pixels counted in windows of several sizes, so that near misses count."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass as checked

from treefit.similarity.bits import INNER
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
        counts, cells = np.empty((2, n), np.uint16), np.empty(2 * rows * columns, np.uint16)
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
    """Fill `counts` (2, n); `memory` holds the cells of two scales. Return whether there is any branch.

    Cells lie in flat memory, a row behind the other: arrays of two dimensions would take seconds to compile.
    """
    height, words = foliage.shape
    flat, spare = counts.reshape(-1), len(memory) // 2
    any_branch, to = False, 0
    for label in range(2):
        bits = foliage if label == 0 else branch
        rows, columns, at = (height + cell - 1) // cell, words * 64 // cell, 0
        filled = _count_pairs(bits, memory) if cell == 2 and height % 2 == 0 else _count_cells(bits, cell, memory)
        any_branch |= label == 1 and filled
        for _ in range(SCALES):
            to = _join_windows(memory, at, rows, columns, flat, to)
            _join_cells(memory, at, rows, columns, spare - at)
            rows, columns, at = (rows + 1) // 2, columns // 2, spare - at
    return any_branch


@njit(**INNER)
def _count_pairs(bits, memory):
    """Count the set bits of squares of 2 pixels, two rows at once; return whether there are any."""
    joined, at = np.uint64(0), 0
    for row in range(0, bits.shape[0], 2):
        for word in range(bits.shape[1]):
            a, b = bits[row, word], bits[row + 1, word]
            joined |= a | b
            a, b = (a & _PAIRS) + ((a >> _1) & _PAIRS), (b & _PAIRS) + ((b >> _1) & _PAIRS)
            even, odd = (a & _FOURS) + (b & _FOURS), ((a >> _2) & _FOURS) + ((b >> _2) & _FOURS)
            sums = memory[at : at + 32]
            for k in range(16):
                sums[2 * k] = (even >> np.uint64(4 * k)) & _15
                sums[2 * k + 1] = (odd >> np.uint64(4 * k)) & _15
            at += 32
    return joined != np.uint64(0)


@njit(**INNER)
def _count_cells(bits, cell, memory):
    """Count the set bits of squares of `cell` pixels, a power of two up to 32; return whether there are any."""
    height, words = bits.shape
    across, lowest, joined = 64 // cell, np.uint64((1 << cell) - 1), np.uint64(0)
    sums = memory[: (height + cell - 1) // cell * words * across]
    for i in range(len(sums)):
        sums[i] = 0
    for row in range(height):
        for word in range(words):
            x = bits[row, word]
            joined |= x
            width = 1
            for every in _FIELDS:
                if width == cell:
                    break
                x = (x & every) + ((x >> np.uint64(width)) & every)
                width *= 2
            at = (row // cell * words + word) * across
            sums = memory[at : at + across]
            for k in range(across):
                sums[k] += np.uint16((x >> np.uint64(k * cell)) & lowest)
    return joined != np.uint64(0)


@njit(**INNER)
def _join_windows(memory, at, rows, columns, counts, to):
    """Put the sums of 2 x 2 cells at every cell into `counts` from `to` on; return the place behind the last."""
    for _ in range(rows - 1):
        upper, lower = memory[at : at + columns], memory[at + columns : at + 2 * columns]
        sums = counts[to : to + columns - 1]
        for i in range(len(sums)):
            sums[i] = upper[i] + upper[i + 1] + lower[i] + lower[i + 1]
        at, to = at + columns, to + columns - 1
    return to


@njit(**INNER)
def _join_cells(memory, at, rows, columns, to):
    """Put the sums of 2 x 2 cells at every other one into the memory from `to` on; behind the last row is nothing."""
    for row in range(0, rows, 2):
        upper, lower = memory[at : at + columns], memory[at + columns : at + 2 * columns]
        sums = memory[to : to + columns // 2]
        for i in range(len(sums)):
            sums[i] = upper[2 * i] + upper[2 * i + 1]
        if row + 1 < rows:
            for i in range(len(sums)):
                sums[i] += lower[2 * i] + lower[2 * i + 1]
        at, to = at + 2 * columns, to + columns // 2


@njit(cache=True, nogil=True)
def agreement(one, two, ends, weight):
    """Mean over the scales of the shared counts by the joined counts, both (2, n)."""
    total, first = 0.0, 0
    for end in ends:
        f_low = f_high = b_low = b_high = np.uint32(0)
        for i in range(first, end):
            at = np.uint64(i)
            f_low += min(one[0, at], two[0, at])
            f_high += max(one[0, at], two[0, at])
            b_low += min(one[1, at], two[1, at])
            b_high += max(one[1, at], two[1, at])
        high = f_high + weight * b_high
        total += (f_low + weight * b_low) / high if high > 0 else 1.0
        first = end
    return total / len(ends)
