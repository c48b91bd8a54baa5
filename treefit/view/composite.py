"""Slabs of depth joined front to back into the two planes of a mask."""

from __future__ import annotations

import numpy as np
from numba import njit

from treefit.plant.compiling import INNER

_CHEQUERED, _ONE = np.uint64(0x5555555555555555), np.uint64(1)
_SWAPS = tuple(
    (np.uint64(step), np.uint64(mask))
    for step, mask in ((1, 0x5555555555555555), (2, 0x3333333333333333), (4, 0x0F0F0F0F0F0F0F0F),
                       (8, 0x00FF00FF00FF00FF), (16, 0x0000FFFF0000FFFF), (32, 0x00000000FFFFFFFF))
)  # fmt: skip


@njit(**INNER)
def composite(bits, slabs, branch, foliage, behind):
    """Join the slabs of `bits` (slabs * 2 * height * words) into the visible planes (height, words).

    Within a slab nobody knows what is in front: leaves are on one half of the pixels, a chequered one, wood on the
    other, so that neither class gains from it. With `behind` 1, else 0, the last slab is the nearest and rows are
    mirrored.
    """
    height, words = branch.shape
    plane = height * words
    first, step = (2 * plane * (slabs - 1), -2 * plane) if behind else (0, 2 * plane)
    for row in range(height):
        wood_first = _CHEQUERED << np.uint64((row + behind) & 1)
        for word in range(words):
            wood, leaves, at = np.uint64(0), np.uint64(0), first + row * words + word
            for _ in range(slabs):
                new_wood, new_leaves = bits[at], bits[at + plane]
                both, open_ = new_wood & new_leaves, ~(wood | leaves)
                wood |= (new_wood ^ (both & ~wood_first)) & open_
                leaves |= (new_leaves ^ (both & wood_first)) & open_
                at += step
            if behind:
                branch[row, words - 1 - word], foliage[row, words - 1 - word] = _mirrored(wood), _mirrored(leaves)
            else:
                branch[row, word], foliage[row, word] = wood, leaves


@njit(**INNER)
def _mirrored(word):
    for step, mask in _SWAPS:
        word = ((word >> step) & mask) | ((word & mask) << step)
    return word
