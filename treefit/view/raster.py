"""Rasteriser of plants into bit rows: one bit a pixel, one plane a class and depth slab, spans OR-ed in.

A pixel belongs to a primitive when its centre does, int(edge + 1/2) being the first centre at or behind an edge, so
that thin twigs and small leaves keep their mean area. A leaf is the ellipse of its own length and width, a segment a
tapered quad (a line where it is thin), a thick joint also a disc.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

BRANCHES, LEAVES = 0, 1
THIN = np.float32(0.75)  # half width in pixels up to which a segment is a line and its joints need no disc
CHUNK = 256  # leaves that are transformed at once
X, Y, SLAB, LONG_X, LONG_Y, REACH, SLOPE, HALF, INVERSE = (CHUNK * row for row in range(9))
ROWS = 9
_ALL = np.uint64(0xFFFFFFFFFFFFFFFF)
_63, _ONE_BIT = np.uint64(63), np.uint64(1)
_HALF, _ZERO, _ONE, _TINY = np.float32(0.5), np.float32(0.0), np.float32(1.0), np.float32(1e-6)


@njit(inline="always", error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def _span(bits, start, words, left, right):
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


@njit(inline="always", error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def _ellipse(bits, base, height, words, x, y, reach, slope, half, inverse):
    """Fill the ellipse around (x, y): `reach` rows up and down, its middle moving by `slope` columns a row."""
    first, end = max(int(y - reach + _HALF), 0), min(int(y + reach + _HALF), height)
    dy = np.float32(first) + _HALF - y
    start = base + first * words
    for _ in range(first, end):
        width = half * math.sqrt(max(_ONE - dy * dy * inverse, _ZERO))
        middle = x + slope * dy
        _span(bits, start, words, middle - width, middle + width)
        dy += _ONE
        start += words


@njit(inline="always", error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def _line(bits, base, height, words, x0, y0, r0, x1, y1, r1):
    """Draw a thin tapered segment: a step a pixel along its longer axis, across it as many centres as it covers."""
    dx, dy = x1 - x0, y1 - y0
    long = math.sqrt(dx * dx + dy * dy)
    steep = abs(dy) > abs(dx)
    u0, u1, v0, dv = (y0, y1, x0, dx) if steep else (x0, x1, y0, dy)
    if u1 < u0:
        u0, u1, v0, dv, r0, r1 = u1, u0, v0 + dv, -dv, r1, r0
    limit = height if steep else words * 64
    first, end = max(int(u0 + _HALF), 0), min(int(u1 + _HALF), limit)
    if first >= end:
        return
    per = _ONE / (u1 - u0)
    across = long * per
    t = (np.float32(first) + _HALF - u0) * per
    for step in range(first, end):
        half = (r0 + (r1 - r0) * t) * across
        middle = v0 + dv * t
        if steep:
            _span(bits, base + step * words, words, middle - half, middle + half)
        else:
            low, high = max(int(middle - half + _HALF), 0), min(int(middle + half + _HALF), height)
            bit = np.uint64(1) << (np.uint64(step) & _63)
            for row in range(low, high):
                bits[base + row * words + (step >> 6)] |= bit
        t += per


@njit(inline="always", error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def _crossing(y, xa, ya, xb, yb, left, right):
    """Widen [left, right] by where the edge from a to b crosses the height y."""
    if (ya <= y) != (yb <= y):
        x = xa + (y - ya) * (xb - xa) / (yb - ya)
        left, right = min(left, x), max(right, x)
    return left, right


@njit(inline="always", error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def _quad(bits, base, height, words, x0, y0, r0, x1, y1, r1):
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
        _span(bits, base + row * words, words, left, right)


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def draw_branches(bits, slabs, height, words, xyz, radius, parent, level, cos, sin, scale, near, per_depth):
    """Draw the segments of a plant into `bits` (slabs * 2 * height * words), `scale` pixels a metre, slab 0 nearest."""
    n, plane, middle, bottom = len(parent), height * words, np.float32(words * 32), np.float32(height)
    columns, rows, depths = np.empty(n, np.float32), np.empty(n, np.float32), np.empty(n, np.float32)
    px, py, pz = xyz
    for i in range(n):
        columns[i] = middle + (cos * px[i] + sin * py[i]) * scale
    for i in range(n):
        depths[i] = (cos * py[i] - sin * px[i] - near) * per_depth * _HALF
    for i in range(n):
        rows[i] = bottom - pz[i] * scale
    for i in range(1, n):
        p = parent[i]
        slab = min(max(int(depths[i] + depths[p]), 0), slabs - 1)
        base = (slab * 2 + BRANCHES) * plane
        r1 = radius[i] * scale
        r0 = r1 if level[i] > level[p] else radius[p] * scale
        if r0 <= THIN:
            _line(bits, base, height, words, columns[p], rows[p], r0, columns[i], rows[i], r1)
            continue
        _quad(bits, base, height, words, columns[p], rows[p], r0, columns[i], rows[i], r1)
        if r1 > THIN:
            _ellipse(bits, base, height, words, columns[i], rows[i], r1, _ZERO, r1, _ONE / (r1 * r1))


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def draw_leaves(bits, slabs, height, words, position, axis, normal, size, cos, sin, scale, near, per_depth):
    """Draw the leaves of a plant as ellipses; arguments as those of draw_branches.

    In chunks: the transform fills the rows of `seen` in loops simple enough for vector instructions.
    """
    seen = np.empty(ROWS * CHUNK, np.float32)
    plane = height * words
    for first in range(0, len(size[0]), CHUNK):
        count = min(CHUNK, len(size[0]) - first)
        _place(seen, first, count, position, axis, size[0], cos, sin, scale, near, per_depth)
        _shape(seen, first, count, axis, normal, size[1], cos, sin, scale)
        middle, bottom = np.float32(words * 32), np.float32(height)
        for j in range(count):
            slab = min(max(int(seen[SLAB + j]), 0), slabs - 1)
            _ellipse(
                bits, (slab * 2 + LEAVES) * plane, height, words, middle + seen[X + j], bottom - seen[Y + j],
                seen[REACH + j], seen[SLOPE + j], seen[HALF + j], seen[INVERSE + j],
            )  # fmt: skip


@njit(inline="always", error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def _place(seen, first, count, position, axis, length, cos, sin, scale, near, per_depth):
    """Middle of the leaves from the trunk base in pixels, y up; their slab; their long half axis in pixels."""
    px, py, pz = position
    ax, ay, az = axis
    for j in range(count):
        i = first + j
        long = _HALF * length[i]
        x, y, z = px[i] + ax[i] * long, py[i] + ay[i] * long, pz[i] + az[i] * long
        seen[X + j], seen[Y + j] = (cos * x + sin * y) * scale, z * scale
        seen[SLAB + j] = (cos * y - sin * x - near) * per_depth
        seen[LONG_X + j], seen[LONG_Y + j] = (cos * ax[i] + sin * ay[i]) * long * scale, -az[i] * long * scale


@njit(inline="always", error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def _shape(seen, first, count, axis, normal, width, cos, sin, scale):
    """What _ellipse needs of each leaf, from its half axes."""
    ax, ay, az = axis
    nx, ny, nz = normal
    for j in range(count):
        i = first + j
        wide = _HALF * width[i] * scale
        bx = (cos * (ny[i] * az[i] - nz[i] * ay[i]) + sin * (nz[i] * ax[i] - nx[i] * az[i])) * wide
        by = (ny[i] * ax[i] - nx[i] * ay[i]) * wide
        long_x, long_y = seen[LONG_X + j], seen[LONG_Y + j]
        square = long_y * long_y + by * by + _TINY
        reach = math.sqrt(square)
        inverse = _ONE / square
        seen[REACH + j], seen[INVERSE + j] = reach, inverse
        seen[SLOPE + j] = (long_x * long_y + bx * by) * inverse
        seen[HALF + j] = abs(long_x * by - long_y * bx) * reach * inverse


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def composite(planes, branch, foliage):
    """Join the slabs front to back into the visible planes (height, words).

    Within a slab nobody knows what is in front: leaves are on one half of the pixels, a chequered one, wood on the
    other, so that neither class gains from it.
    """
    for row in range(planes.shape[2]):
        wood_first = np.uint64(0x5555555555555555) << np.uint64(row & 1)
        for word in range(planes.shape[3]):
            covered, wood, leaves = np.uint64(0), np.uint64(0), np.uint64(0)
            for slab in range(planes.shape[0]):
                new_wood, new_leaves = planes[slab, BRANCHES, row, word], planes[slab, LEAVES, row, word]
                both = new_wood & new_leaves
                wood |= (new_wood ^ (both & ~wood_first)) & ~covered
                leaves |= (new_leaves ^ (both & wood_first)) & ~covered
                covered |= new_wood | new_leaves
            branch[row, word], foliage[row, word] = wood, leaves
