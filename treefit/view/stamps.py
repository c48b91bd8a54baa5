"""Stamps: small primitives put into bit rows without branches, a chunk of them at a time.

A row of a stamp is a mask of at most COLUMNS pixels, made for the whole chunk in a loop that vector instructions can
run, then shifted into the word where its left edge is; few stamps cross into the word behind. What is too large, or
reaches over the edge of the frame, is odd and is drawn span by span.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from treefit.plant.compiling import INNER, ONCE

CHUNK = 256  # primitives at once: their numbers stay in the nearest cache
COLUMNS, ROWS = 24, 12  # of the largest stamp
BLOCK = 3  # rows put at once: neighbours in a chunk share words, and a word must be stored before it is read again
AT, SHIFT, KIND, TALL, CROSSING, ODD = (CHUNK * row for row in range(6))
"""Rows of a chunk's integers: first word, shift, kind, count of rows; places of those that cross, of the odd ones."""
INTEGERS, MASKS = 6 * CHUNK, BLOCK * CHUNK
INSIDE, ACROSS, OUT = np.int32(0), np.int32(1), np.int32(2)
"""Kinds: in one word, across two, no stamp."""
_ONE, _63 = np.uint64(1), np.uint64(63)


@njit(**INNER)
def survey(ints, count):
    """Most rows of a stamp in the chunk, and whether some stamps are not INSIDE."""
    tall, kind = np.int32(0), np.int32(0)
    for j in range(count):
        tall = max(tall, ints[TALL + j])
        kind = max(kind, ints[KIND + j])
    return tall, kind > INSIDE


@njit(**INNER)
def sort(ints, count):
    """List the stamps that cross words and the odd ones; return their counts."""
    crossing = odd = 0
    for j in range(count):
        ints[CROSSING + crossing], ints[ODD + odd] = j, j
        crossing += ints[KIND + j] == ACROSS
        odd += ints[KIND + j] == OUT
    return crossing, odd


@njit(**INNER)
def stamp(bits, ints, masks, count, crossing, row, rows, words):
    """Put `rows` (1 to BLOCK) rows of masks, the first of them row number `row` of each stamp.

    The first `crossing` listed stamps also have pixels in the word behind.
    """
    start = row * words
    if rows == 1:
        for j in range(count):
            _put(bits, ints, masks, j, 0, start)
    elif rows == 2:
        for j in range(count):
            _put(bits, ints, masks, j, 0, start)
            _put(bits, ints, masks, j, 1, start + words)
    else:
        for j in range(count):
            _put(bits, ints, masks, j, 0, start)
            _put(bits, ints, masks, j, 1, start + words)
            _put(bits, ints, masks, j, 2, start + 2 * words)
    for i in range(crossing):
        j = ints[CROSSING + i]
        at, shift = ints[AT + j] + start + 1, _63 - np.uint64(ints[SHIFT + j])
        for k in range(rows):
            bits[np.uint64(at + k * words)] |= (np.uint64(masks[CHUNK * k + j]) >> _ONE) >> shift


@njit(**ONCE)
def _put(bits, ints, masks, j, row, start):
    bits[np.uint64(ints[AT + j] + start)] |= np.uint64(masks[CHUNK * row + j]) << np.uint64(ints[SHIFT + j])
