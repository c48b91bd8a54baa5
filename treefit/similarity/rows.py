"""Rows: what there is to know of every row of pixels of a mask, from its bit rows."""

from __future__ import annotations

import threading

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.similarity.bits import INNER, highest_bit, lowest_bit, popcount
from treefit.view.frame import BitMask

LEFT, RIGHT, AREA, RUNS, STARTS, WOOD, WOOD_LEFT, WOOD_RIGHT, MOMENT = range(9)
"""Fields: first column and the one behind the last; pixels of the tree; those with background a step to their left;
those with background a step above; branch pixels, their first column and the one behind their last; sum of the columns
of the tree's pixels."""
FIELDS = 9
STEPS = 128  # steps in a height: gaps are looked for at this distance, so that they do not depend on the resolution


def step(height: int) -> int:
    """Pixels of a step at `height` rows, 1 at least and at most 63."""
    return min(max(1, round(height / STEPS)), 63)


class _Last(threading.local):
    """Mask scanned last by a thread and its fields: several terms ask for those of one mask, one after the other."""

    bits: BitMask | None = None
    fields: NDArray[np.int32]


_LAST = _Last()


def rows(bits: BitMask) -> NDArray[np.int32]:
    """Fields (FIELDS, height) int32 of every row, from the top down; columns are 0 in an empty row."""
    if _LAST.bits is not bits:
        fields = np.empty((FIELDS, bits.branch.shape[0]), np.int32)
        scan(bits.branch, bits.foliage, step(bits.branch.shape[0]), fields)
        _LAST.bits, _LAST.fields = bits, fields
    return _LAST.fields


@njit(cache=True, nogil=True)
def scan(branch, foliage, step, fields):
    """Fill `fields` from bit rows (height, words)."""
    height, words = branch.shape
    ahead, rest = np.uint64(step), np.uint64(64 - step)
    for row in range(height):
        left = right = wood_left = wood_right = area = runs = starts = wood = moment = 0
        before = np.uint64(0)
        for word in range(words):
            b = branch[row, word]
            s = b | foliage[row, word]
            if s == np.uint64(0):
                before = s
                continue
            above = branch[row - step, word] | foliage[row - step, word] if row >= step else np.uint64(0)
            first = word * 64
            if area == 0:
                left = first + lowest_bit(s)
            right = first + highest_bit(s) + 1
            if b != np.uint64(0):
                if wood == 0:
                    wood_left = first + lowest_bit(b)
                wood_right = first + highest_bit(b) + 1
                wood += popcount(b)
            count = popcount(s)
            area += count
            runs += popcount(s & ~((s << ahead) | (before >> rest)))
            starts += popcount(s & ~above)
            moment += first * count + _places(s)
            before = s
        fields[LEFT, row], fields[RIGHT, row], fields[AREA, row] = left, right, area
        fields[RUNS, row], fields[STARTS, row], fields[MOMENT, row] = runs, starts, moment
        fields[WOOD, row], fields[WOOD_LEFT, row], fields[WOOD_RIGHT, row] = wood, wood_left, wood_right


@njit(**INNER)
def _places(x):
    """Sum of the places of the set bits of a word."""
    total = 0
    for j, mask in enumerate(_PLACES):
        total += popcount(x & mask) << j
    return total


_PLACES = (
    np.uint64(0xAAAAAAAAAAAAAAAA), np.uint64(0xCCCCCCCCCCCCCCCC), np.uint64(0xF0F0F0F0F0F0F0F0),
    np.uint64(0xFF00FF00FF00FF00), np.uint64(0xFFFF0000FFFF0000), np.uint64(0xFFFFFFFF00000000),
)  # fmt: skip
