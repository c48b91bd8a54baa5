"""Stripes: a mask as 20-30 horizontal bands with their borders and shares (sec. 4, figs. 1 and 2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.similarity.bits import highest_bit, lowest_bit, popcount
from treefit.view.frame import BitMask

DENSE_SHARE = 0.75  # "dense crown borders (>75% leaves pixels)" (sec. 4)


@dataclass(frozen=True, eq=False)
class Stripes:
    """s stripes from the top down; lengths in plant heights with x = 0 at the trunk base.

    `crown` (s, 2) are the borders a, d of the content, `dense` (s, 2) the borders b, c of the dense crown, an empty
    interval at the middle when no column is dense; an empty stripe has a = d = 0. `branch` and `foliage` (s,) are
    the shares B, L of their pixels between a and d.
    """

    crown: NDArray[np.float32]
    dense: NDArray[np.float32]
    branch: NDArray[np.float32]
    foliage: NDArray[np.float32]

    def __len__(self) -> int:
        """Count of stripes."""
        return len(self.branch)


def stripes(bits: BitMask, count: int) -> Stripes:
    """Divide the bit rows of a mask into `count` stripes; ValueError when there are fewer rows than stripes."""
    rows = bits.branch.shape[0]
    if not 1 <= count <= rows:
        raise ValueError(f"stripes: count must be in [1, {rows}] for a mask of {rows} rows, got {count}")
    crown, dense = np.empty((count, 2), np.float32), np.empty((count, 2), np.float32)
    branch, foliage = np.empty(count, np.float32), np.empty(count, np.float32)
    measure(bits.branch, bits.foliage, crown, dense, branch, foliage)
    return Stripes(crown, dense, branch, foliage)


@njit(cache=True, nogil=True, error_model="numpy")
def measure(branch_bits, foliage_bits, crown, dense, branch, foliage):
    """Fill the arrays of Stripes from bit rows (height, words)."""
    height, words = branch_bits.shape
    count = len(branch)
    middle, unit = np.float32(words * 32), np.float32(1.0 / height)
    dense_columns, planes = np.empty(words, np.uint64), np.empty(16, np.uint64)
    for s in range(count):
        first, end = s * height // count, (s + 1) * height // count
        left, right, wood, leaves = -1, -1, 0, 0
        for word in range(words):
            anything = np.uint64(0)
            for row in range(first, end):
                b, f = branch_bits[row, word], foliage_bits[row, word]
                anything |= b | f
                wood += popcount(b)
                leaves += popcount(f)
            if anything:
                if left < 0:
                    left = word * 64 + lowest_bit(anything)
                right = word * 64 + highest_bit(anything) + 1
            dense_columns[word] = _columns_over(foliage_bits, word, first, end, planes)
        if left < 0:
            crown[s], dense[s], branch[s], foliage[s] = 0.0, 0.0, 0.0, 0.0
            continue
        area = np.float32((end - first) * (right - left))
        branch[s], foliage[s] = wood / area, leaves / area
        crown[s, 0], crown[s, 1] = (left - middle) * unit, (right - middle) * unit
        start, length = _longest_run(dense_columns)
        if length == 0:
            dense[s] = np.float32(0.5) * (crown[s, 0] + crown[s, 1])
        else:
            dense[s, 0], dense[s, 1] = (start - middle) * unit, (start + length - middle) * unit


@njit(inline="always")
def _columns_over(bits, word, first, end, planes):
    """Bits of the columns of one word whose count over the rows is above DENSE_SHARE of them.

    Bit-sliced counters: plane j holds bit j of every column's count, which starts so that the wanted one overflows.
    """
    n_planes = 1
    while (1 << n_planes) < end - first + 1:
        n_planes += 1
    start = (1 << n_planes) - (int(DENSE_SHARE * (end - first)) + 1)
    for j in range(n_planes):
        planes[j] = ~np.uint64(0) if (start >> j) & 1 else np.uint64(0)
    over = np.uint64(0)
    for row in range(first, end):
        carry = bits[row, word]
        for j in range(n_planes):
            planes[j], carry = planes[j] ^ carry, planes[j] & carry
        over |= carry
    return over


@njit(inline="always")
def _longest_run(columns):
    """Start and length of the longest run of set bits over the words."""
    best_start = best = start = run = 0
    for word in range(len(columns)):
        place = 0
        while place < 64:
            rest = columns[word] >> np.uint64(place)
            gap = lowest_bit(rest)
            if gap > 0:
                run = 0
            place += gap
            if place >= 64:
                break
            if run == 0:
                start = word * 64 + place
            length = lowest_bit(~(rest >> np.uint64(gap)))
            run, place = run + length, place + length
            if run > best:
                best_start, best = start, run
    return best_start, best
