"""Primitives of any size filled span by span into bit rows: ellipses, thin lines, tapered quads.

A pixel belongs to a primitive when its centre does, int(edge + 1/2) being the first centre at or behind an edge, so
that thin twigs and small leaves keep their mean area.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from treefit.plant.compiling import INNER

_ALL = np.uint64(0xFFFFFFFFFFFFFFFF)
_63, _ONE_BIT = np.uint64(63), np.uint64(1)
_HALF, _ZERO, _ONE, _SAFE, _TINY = (np.float32(x) for x in (0.5, 0.0, 1.0, 1.05, 1e-6))


@njit(**INNER)
def span(bits, start, words, left, right):
    """Set the pixels of the row of `words` words at `start` whose centres lie in [left, right], columns in pixels.

    Without branches up to 63 pixels: an empty span sets nothing, and the word behind may be touched but not changed.
    """
    first, end = max(int(left + _HALF), 0), min(int(right + _HALF), words * 64)
    count = end - first
    if count < 64:
        mask = (_ONE_BIT << np.uint64(max(count, 0))) - _ONE_BIT
        shift = np.uint64(first) & _63
        word = start + min(first >> 6, words - 1)
        bits[word] |= mask << shift
        bits[word + 1] |= (mask >> _ONE_BIT) >> (_63 - shift)
        return
    last = end - 1
    a, b = first >> 6, last >> 6
    bits[start + a] |= _ALL << (np.uint64(first) & _63)
    for word in range(start + a + 1, start + b):
        bits[word] = _ALL
    bits[start + b] |= _ALL >> (_63 - (np.uint64(last) & _63))


@njit(**INNER)
def ellipse(bits, base, height, words, x, y, reach, slope, half, inverse):
    """Fill the ellipse around (x, y): `reach` rows up and down, its middle moving by `slope` columns a row."""
    first, end = max(int(y - reach + _HALF), 0), min(int(y + reach + _HALF), height)
    dy = np.float32(first) + _HALF - y
    start = base + first * words
    for _ in range(first, end):
        width = half * math.sqrt(max(_ONE - dy * dy * inverse, _ZERO))
        middle = x + slope * dy
        span(bits, start, words, middle - width, middle + width)
        dy += _ONE
        start += words


@njit(**INNER)
def strip(x0, y0, r0, x1, y1, r1):
    """Thin tapered segment as a strip that is told row by row.

    Rows [upper, under] and columns [least, most] that it keeps to; `e` rows below y0 its middle is at
    middle + slope * e and its half width half + widening * e. A steep one ends at rows, a flat one at columns; one so
    level that it tapers faster than it falls has no taper.
    """
    dx, dy = x1 - x0, y1 - y0
    wide, high = abs(dx), abs(dy)
    long, steep = math.sqrt(dx * dx + dy * dy), high > wide
    across = long / max(max(wide, high), _TINY)
    reach = max(r0, r1) * across
    beside, above = (reach, _ZERO) if steep else (_ZERO, reach)
    gain = _ZERO if steep else (r1 - r0) * across
    level = high < _SAFE * abs(gain)
    mean = _HALF * (r0 + r1)
    r0, r1, gain = (mean, mean, _ZERO) if level else (r0, r1, gain)
    inverse = _ONE / max(dy * dy - gain * gain, _TINY)
    middle = x0 + dx * r0 * across * gain * inverse
    upper, under, least, most = min(y0, y1) - above, max(y0, y1) + above, min(x0, x1) - beside, max(x0, x1) + beside
    return (
        upper, under, least, most, middle, dx * dy * inverse,
        r0 * long * high * inverse, (r1 - r0) * long * math.copysign(inverse, dy),
    )  # fmt: skip


@njit(**INNER)
def line(bits, base, height, words, x0, y0, r0, x1, y1, r1):
    """Draw a thin segment as its strip."""
    upper, under, least, most, middle, slope, half, widening = strip(x0, y0, r0, x1, y1, r1)
    for row in range(max(int(upper + _HALF), 0), min(int(under + _HALF), height)):
        e = np.float32(row) + _HALF - y0
        x, reach = middle + slope * e, half + widening * e
        span(bits, base + row * words, words, max(x - reach, least), min(x + reach, most))


@njit(**INNER)
def _crossing(y, xa, ya, xb, yb, left, right):
    """Widen [left, right] by where the edge from a to b crosses the height y."""
    if (ya <= y) != (yb <= y):
        x = xa + (y - ya) * (xb - xa) / (yb - ya)
        left, right = min(left, x), max(right, x)
    return left, right


@njit(**INNER)
def quad(bits, base, height, words, x0, y0, r0, x1, y1, r1):
    """Fill the tapered quad around the line from (x0, y0) to (x1, y1), half widths r0, r1, in pixels."""
    dx, dy = x1 - x0, y1 - y0
    scale = _ONE / (math.sqrt(dx * dx + dy * dy) + _TINY)
    nx, ny = -dy * scale, dx * scale
    xa, ya, xb, yb = x0 + nx * r0, y0 + ny * r0, x1 + nx * r1, y1 + ny * r1
    xc, yc, xd, yd = x1 - nx * r1, y1 - ny * r1, x0 - nx * r0, y0 - ny * r0
    first = max(int(min(min(ya, yb), min(yc, yd)) + _HALF), 0)
    end = min(int(max(max(ya, yb), max(yc, yd)) + _HALF), height)
    for row in range(first, end):
        y = np.float32(row) + _HALF
        left, right = np.float32(1e9), np.float32(-1e9)
        left, right = _crossing(y, xa, ya, xb, yb, left, right)
        left, right = _crossing(y, xb, yb, xc, yc, left, right)
        left, right = _crossing(y, xc, yc, xd, yd, left, right)
        left, right = _crossing(y, xd, yd, xa, ya, left, right)
        span(bits, base + row * words, words, left, right)
