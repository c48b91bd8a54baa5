"""Leaves in bit rows: each is the ellipse of its own length and width."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from treefit.plant.compiling import INNER, ONCE
from treefit.view import stamps
from treefit.view.spans import ellipse
from treefit.view.stamps import ACROSS, AT, BLOCK, CHUNK, INSIDE, KIND, ODD, OUT, SHIFT, TALL

X, Y, DEPTH, LONG_X, LONG_Y, REACH, SLOPE, HALF, INVERSE, ASIDE, DY, MIDDLE, WIDTH = (CHUNK * row for row in range(13))
FLOATS = 13 * CHUNK
_HALF, _ZERO, _ONE, _TINY, _FAR = (np.float32(x) for x in (0.5, 0.0, 1.0, 1e-6, 1e6))
_BIT, _31 = np.uint32(1), np.uint32(31)


@njit(**ONCE)
def draw_leaves(
    bits, slabs, height, words, position, axis, normal, size, cos, sin, scale, near, per_depth, floats, ints, masks
):
    """Draw the leaves of a plant into `bits` (slabs * 2 * height * words), `scale` pixels a metre, slab 0 nearest."""
    for first in range(0, len(size[0]), CHUNK):
        end = min(first + CHUNK, len(size[0]))
        count = end - first
        _place(floats, first, end, position, axis, size[0], cos, sin, scale, near, per_depth)
        _shape(floats, first, end, axis, normal, size[1], cos, sin, scale)
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
def _place(floats, first, end, position, axis, length, cos, sin, scale, near, per_depth):
    """Middle of the leaves from the trunk base in pixels, y up; their slab; their long half axis in pixels."""
    px, py, pz = position[0][first:end], position[1][first:end], position[2][first:end]
    ax, ay, az = axis[0][first:end], axis[1][first:end], axis[2][first:end]
    length = length[first:end]
    for j in range(len(length)):
        long = _HALF * length[j]
        x, y, z = px[j] + ax[j] * long, py[j] + ay[j] * long, pz[j] + az[j] * long
        floats[X + j], floats[Y + j] = (cos * x + sin * y) * scale, z * scale
        floats[DEPTH + j] = (cos * y - sin * x - near) * per_depth
        floats[LONG_X + j], floats[LONG_Y + j] = (cos * ax[j] + sin * ay[j]) * long * scale, -az[j] * long * scale


@njit(**INNER)
def _shape(floats, first, end, axis, normal, width, cos, sin, scale):
    """What an ellipse is row by row, from its half axes; how far it reaches aside."""
    ax, ay, az = axis[0][first:end], axis[1][first:end], axis[2][first:end]
    nx, ny, nz = normal[0][first:end], normal[1][first:end], normal[2][first:end]
    width = width[first:end]
    for j in range(len(width)):
        wide = _HALF * width[j] * scale
        bx = (cos * (ny[j] * az[j] - nz[j] * ay[j]) + sin * (nz[j] * ax[j] - nx[j] * az[j])) * wide
        by = (ny[j] * ax[j] - nx[j] * ay[j]) * wide
        long_x, long_y = floats[LONG_X + j], floats[LONG_Y + j]
        square = long_y * long_y + by * by + _TINY
        reach, inverse = math.sqrt(square), _ONE / square
        floats[REACH + j], floats[INVERSE + j] = reach, inverse
        floats[SLOPE + j] = (long_x * long_y + bx * by) * inverse
        floats[HALF + j] = abs(long_x * by - long_y * bx) * reach * inverse
        floats[ASIDE + j] = math.sqrt(long_x * long_x + bx * bx)


@njit(**INNER)
def _locate(floats, ints, count, slabs, height, words):
    """Kind, first word, shift and count of rows of each stamp; its middle in its own rows and columns."""
    middle, bottom, deepest = np.float32(words * 32), np.float32(height), np.float32(slabs) - _HALF
    lowest, rightmost = bottom - np.float32(stamps.ROWS + BLOCK), np.float32(words * 64 - 1)
    for j in range(count):
        x = min(max(middle + floats[X + j], -_FAR), _FAR)
        y = min(max(bottom - floats[Y + j], -_FAR), _FAR)
        reach, aside = min(floats[REACH + j], _FAR), min(floats[ASIDE + j], _FAR)
        slab = np.int32(min(max(floats[DEPTH + j], _ZERO), deepest))
        top, left, last = np.int32(y - reach + _HALF), np.int32(x - aside - _HALF), np.int32(x + aside + _HALF)
        tall = np.int32(y + reach + _HALF) - top
        fits = (y - reach >= _ZERO) & (y + reach < lowest) & (x - aside >= _ONE) & (x + aside < rightmost)
        fits &= (tall <= stamps.ROWS) & (last - left <= stamps.COLUMNS)
        across = ACROSS if (left & 63) + (last - left) > 63 else INSIDE
        ints[AT + j] = ((slab * 2 + 1) * height + top) * words + (left >> 6) if fits else 0
        ints[SHIFT + j] = left & 63
        ints[TALL + j] = tall if fits else 0
        ints[KIND + j] = across if fits else OUT
        floats[DY + j] = np.float32(top) + _HALF - y
        floats[MIDDLE + j] = x - np.float32(left) + _HALF
        floats[WIDTH + j] = floats[HALF + j] if fits else _ZERO


@njit(**INNER)
def _mask(floats, masks, count, row):
    """Masks of one row of the stamps; empty outside of the ellipse, whatever the middle is there."""
    for j in range(count):
        dy = floats[DY + j] + row
        width = floats[WIDTH + j] * math.sqrt(max(_ONE - dy * dy * floats[INVERSE + j], _ZERO))
        middle = floats[MIDDLE + j] + floats[SLOPE + j] * dy
        left, right = np.uint32(np.int32(middle - width)) & _31, np.uint32(np.int32(middle + width)) & _31
        masks[j] = (_BIT << right) - (_BIT << left)


@njit(**INNER)
def _fill(bits, floats, j, slabs, height, words):
    slab = int(min(max(floats[DEPTH + j], _ZERO), np.float32(slabs) - _HALF))
    ellipse(
        bits, (slab * 2 + 1) * height * words, height, words,
        np.float32(words * 32) + floats[X + j], np.float32(height) - floats[Y + j],
        floats[REACH + j], floats[SLOPE + j], floats[HALF + j], floats[INVERSE + j],
    )  # fmt: skip
