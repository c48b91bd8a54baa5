"""Branches in bit rows: a segment is a tapered quad, a line where it is thin; a thick joint is also a disc."""

from __future__ import annotations

import numpy as np
from numba import njit

from treefit.plant.compiling import INNER, ONCE
from treefit.view import stamps
from treefit.view.spans import ellipse, line, quad, strip
from treefit.view.stamps import ACROSS, AT, BLOCK, CHUNK, INSIDE, KIND, ODD, OUT, SHIFT, TALL

THIN = np.float32(0.75)  # half width in pixels up to which a segment is a line and its joints need no disc
X0, Y0, R0, X1, Y1, R1, DEPTH, DY, MIDDLE, SLOPE, WIDTH, WIDENING, LEAST, MOST, END = (CHUNK * row for row in range(15))
FLOATS = 15 * CHUNK
_HALF, _ZERO, _ONE, _FAR = (np.float32(x) for x in (0.5, 0.0, 1.0, 1e6))
_BIT, _31 = np.uint32(1), np.uint32(31)


@njit(**ONCE)
def draw_branches(
    bits, slabs, height, words, xyz, radius, parent, level, cos, sin, scale, near, per_depth, seen, floats, ints, masks
):
    """Draw the segments of a plant into `bits` (slabs * 2 * height * words), `scale` pixels a metre, slab 0 nearest.

    `seen` (3 * v) takes columns, rows and depths of the vertices.
    """
    n = len(parent)
    columns, lines, depths = seen[:n], seen[n : 2 * n], seen[2 * n : 3 * n]
    _see(columns, lines, depths, xyz, height, words, cos, sin, scale, near, per_depth)
    for first in range(1, n, CHUNK):
        count = min(CHUNK, n - first)
        _ends(floats, first, count, columns, lines, depths, radius, parent, level, scale)
        _locate(floats, ints, count, slabs, height, words)
        tall, special = stamps.survey(ints, count)
        crossing, odd = stamps.sort(ints, count) if special else (0, 0)
        for row in range(0, tall, BLOCK):
            rows = min(BLOCK, tall - row)
            for i in range(rows):
                _mask(floats, masks[CHUNK * i : CHUNK * (i + 1)], count, np.float32(row + i))
            stamps.stamp(bits, ints, masks, count, crossing, row, rows, words)
        for i in range(odd):
            _fill(bits, floats, ints[ODD + i], slabs, height, words)


@njit(**INNER)
def _see(columns, rows, depths, xyz, height, words, cos, sin, scale, near, per_depth):
    px, py, pz = xyz
    middle, bottom = np.float32(words * 32), np.float32(height)
    for i in range(len(columns)):
        columns[i] = middle + (cos * px[i] + sin * py[i]) * scale
    for i in range(len(depths)):
        depths[i] = (cos * py[i] - sin * px[i] - near) * per_depth * _HALF
    for i in range(len(rows)):
        rows[i] = bottom - pz[i] * scale


@njit(**INNER)
def _ends(floats, first, count, columns, rows, depths, radius, parent, level, scale):
    """Ends, radii and depth of the segments from vertex `first` on; a new stem begins as thick as it ends."""
    for j in range(count):
        i = first + j
        p = np.uint64(parent[i])
        r0, r1 = radius[p], radius[i]
        floats[X0 + j], floats[Y0 + j], floats[DEPTH + j] = columns[p], rows[p], depths[p] + depths[i]
        floats[R0 + j] = scale * (r1 if level[i] > level[p] else r0)
    columns, rows, radius = columns[first : first + count], rows[first : first + count], radius[first : first + count]
    for j in range(count):
        floats[X1 + j], floats[Y1 + j], floats[R1 + j] = columns[j], rows[j], scale * radius[j]


@njit(**INNER)
def _locate(floats, ints, count, slabs, height, words):
    """Kind, first word, shift and count of rows of each stamp; the strip of its thin line in its rows and columns.

    A flat line ends at columns (LEAST, MOST), a steep one at rows: those before END.
    """
    bottom, deepest = np.float32(height), np.float32(slabs) - _HALF
    lowest, rightmost = bottom - np.float32(stamps.ROWS + BLOCK), np.float32(words * 64 - 1)
    for j in range(count):
        x0, x1 = min(max(floats[X0 + j], -_FAR), _FAR), min(max(floats[X1 + j], -_FAR), _FAR)
        y0, y1 = min(max(floats[Y0 + j], -_FAR), _FAR), min(max(floats[Y1 + j], -_FAR), _FAR)
        upper, under, least, most, middle, slope, half, widening = strip(x0, y0, floats[R0 + j], x1, y1, floats[R1 + j])
        slab = np.int32(min(max(floats[DEPTH + j], _ZERO), deepest))
        top, left, last = np.int32(upper + _HALF), np.int32(least - _HALF), np.int32(most + _HALF)
        tall = np.int32(under + _HALF) - top
        fits = (floats[R0 + j] <= THIN) & (upper >= _ZERO) & (under < lowest) & (least >= _ONE) & (most < rightmost)
        fits &= (tall <= stamps.ROWS) & (last - left <= stamps.COLUMNS)
        across = ACROSS if (left & 63) + (last - left) > 63 else INSIDE
        ints[AT + j] = (slab * 2 * height + top) * words + (left >> 6) if fits else 0
        ints[SHIFT + j] = left & 63
        ints[TALL + j] = tall if fits else 0
        ints[KIND + j] = across if fits else OUT
        at = np.float32(left) - _HALF
        floats[DY + j] = np.float32(top) + _HALF - y0
        floats[MIDDLE + j], floats[SLOPE + j] = middle - at, slope
        floats[WIDTH + j], floats[WIDENING + j] = half, widening
        floats[LEAST + j], floats[MOST + j] = least - at, most - at
        floats[END + j] = np.float32(tall) if fits else _ZERO


@njit(**INNER)
def _mask(floats, masks, count, row):
    """Masks of one row of the stamps."""
    for j in range(count):
        e = floats[DY + j] + row
        middle, half = floats[MIDDLE + j] + floats[SLOPE + j] * e, floats[WIDTH + j] + floats[WIDENING + j] * e
        least, most = floats[LEAST + j], floats[MOST + j]
        first = np.int32(min(max(middle - half, least), most))
        end = max(np.int32(max(min(middle + half, most), least)), first)
        end = end if row < floats[END + j] else first
        left, right = np.uint32(first) & _31, np.uint32(end) & _31
        masks[j] = (_BIT << right) - (_BIT << left)


@njit(**INNER)
def _fill(bits, floats, j, slabs, height, words):
    base = int(min(max(floats[DEPTH + j], _ZERO), np.float32(slabs) - _HALF)) * 2 * height * words
    x0, y0, r0 = floats[X0 + j], floats[Y0 + j], floats[R0 + j]
    x1, y1, r1 = floats[X1 + j], floats[Y1 + j], floats[R1 + j]
    if r0 <= THIN:
        line(bits, base, height, words, x0, y0, r0, x1, y1, r1)
        return
    quad(bits, base, height, words, x0, y0, r0, x1, y1, r1)
    if r1 > THIN:
        ellipse(bits, base, height, words, x1, y1, r1, _ZERO, r1, _ONE / (r1 * r1))
