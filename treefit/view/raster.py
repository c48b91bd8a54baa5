"""Rasteriser of plants into bit rows: one bit a pixel, one plane a class and depth slab, spans OR-ed in.

A pixel belongs to a primitive when its centre does, so that thin twigs and small leaves keep their mean area. A leaf
is the ellipse of its own length and width, a segment a tapered quad, a thick joint also a disc.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

SLABS = 6
BRANCHES, LEAVES = 0, 1
_ALL = np.uint64(0xFFFFFFFFFFFFFFFF)
_63, _6 = np.uint64(63), np.uint64(6)


@njit(inline="always")
def _span(plane, row, left, right):
    """Set the pixels of `row` whose centres lie in [left, right], columns in pixels."""
    first = max(int(math.ceil(left - np.float32(0.5))), 0)
    last = min(int(math.floor(right - np.float32(0.5))), plane.shape[1] * 64 - 1)
    if first > last:
        return
    a, b = first >> 6, last >> 6
    head = _ALL << (np.uint64(first) & _63)
    tail = _ALL >> (_63 - (np.uint64(last) & _63))
    if a == b:
        plane[row, a] |= head & tail
        return
    plane[row, a] |= head
    for word in range(a + 1, b):
        plane[row, word] = _ALL
    plane[row, b] |= tail


@njit(inline="always")
def _ellipse(plane, x, y, ax, ay, bx, by):
    """Fill the ellipse with the half axes (ax, ay), (bx, by) around (x, y), in pixels."""
    square = ay * ay + by * by + np.float32(1e-12)
    reach = np.float32(math.sqrt(square))
    first = max(int(math.ceil(y - reach - np.float32(0.5))), 0)
    last = min(int(math.floor(y + reach - np.float32(0.5))), plane.shape[0] - 1)
    if first > last:
        return
    inverse = np.float32(1.0) / square
    slope = (ax * ay + bx * by) * inverse
    half = abs(ax * by - ay * bx) / reach
    for row in range(first, last + 1):
        dy = np.float32(row) + np.float32(0.5) - y
        width = half * np.float32(math.sqrt(max(np.float32(1.0) - dy * dy * inverse, np.float32(0.0))))
        middle = x + slope * dy
        _span(plane, row, middle - width, middle + width)


@njit(inline="always")
def _quad(plane, x0, y0, r0, x1, y1, r1):
    """Fill the tapered quad around the line from (x0, y0) to (x1, y1), half widths r0, r1, in pixels."""
    dx, dy = x1 - x0, y1 - y0
    scale = np.float32(1.0) / np.float32(math.sqrt(dx * dx + dy * dy) + 1e-6)
    nx, ny = -dy * scale, dx * scale
    xa, ya, xb, yb = x0 + nx * r0, y0 + ny * r0, x1 + nx * r1, y1 + ny * r1
    xc, yc, xd, yd = x1 - nx * r1, y1 - ny * r1, x0 - nx * r0, y0 - ny * r0
    first = max(int(math.ceil(min(min(ya, yb), min(yc, yd)) - np.float32(0.5))), 0)
    last = min(int(math.floor(max(max(ya, yb), max(yc, yd)) - np.float32(0.5))), plane.shape[0] - 1)
    for row in range(first, last + 1):
        y = np.float32(row) + np.float32(0.5)
        left, right = np.float32(1e9), np.float32(-1e9)
        if (ya <= y) != (yb <= y):
            x = xa + (y - ya) * (xb - xa) / (yb - ya)
            left, right = min(left, x), max(right, x)
        if (yb <= y) != (yc <= y):
            x = xb + (y - yb) * (xc - xb) / (yc - yb)
            left, right = min(left, x), max(right, x)
        if (yc <= y) != (yd <= y):
            x = xc + (y - yc) * (xd - xc) / (yd - yc)
            left, right = min(left, x), max(right, x)
        if (yd <= y) != (ya <= y):
            x = xd + (y - yd) * (xa - xd) / (ya - yd)
            left, right = min(left, x), max(right, x)
        _span(plane, row, left, right)


@njit(cache=True, nogil=True)
def draw(
    planes, xyz, radius, parent, level, leaf_xyz, leaf_axis, leaf_normal, leaf_size, cos, sin, scale, near, far
):  # fmt: skip
    """Draw a plant into `planes` (SLABS, 2, height, words), `scale` pixels a metre, slab 0 nearest."""
    height, middle = np.float32(planes.shape[2]), np.float32(planes.shape[3] * 32)
    slab_of = np.float32(SLABS) / (far - near + np.float32(1e-6))
    half = np.float32(0.5)
    for i in range(1, xyz.shape[1]):
        p = parent[i]
        depth = cos * (xyz[1, i] + xyz[1, p]) * half - sin * (xyz[0, i] + xyz[0, p]) * half
        plane = planes[min(max(int((depth - near) * slab_of), 0), SLABS - 1), BRANCHES]
        x0, y0 = middle + (cos * xyz[0, p] + sin * xyz[1, p]) * scale, height - xyz[2, p] * scale
        x1, y1 = middle + (cos * xyz[0, i] + sin * xyz[1, i]) * scale, height - xyz[2, i] * scale
        r1 = radius[i] * scale
        r0 = r1 if level[i] > level[p] else radius[p] * scale
        _quad(plane, x0, y0, r0, x1, y1, r1)
        if r1 > np.float32(0.75):
            _ellipse(plane, x1, y1, r1, np.float32(0.0), np.float32(0.0), r1)
    for i in range(leaf_xyz.shape[1]):
        ax, ay, az = leaf_axis[0, i], leaf_axis[1, i], leaf_axis[2, i]
        nx, ny, nz = leaf_normal[0, i], leaf_normal[1, i], leaf_normal[2, i]
        long, wide = half * leaf_size[0, i], half * leaf_size[1, i]
        x, y, z = leaf_xyz[0, i] + ax * long, leaf_xyz[1, i] + ay * long, leaf_xyz[2, i] + az * long
        bx, by, bz = ny * az - nz * ay, nz * ax - nx * az, nx * ay - ny * ax
        depth = cos * y - sin * x
        long, wide = long * scale, wide * scale
        _ellipse(
            planes[min(max(int((depth - near) * slab_of), 0), SLABS - 1), LEAVES],
            middle + (cos * x + sin * y) * scale, height - z * scale,
            (cos * ax + sin * ay) * long, -az * long, (cos * bx + sin * by) * wide, -bz * wide,
        )  # fmt: skip


@njit(cache=True, nogil=True)
def composite(planes, branch, foliage):
    """Join the slabs front to back into the visible planes (height, words).

    Within a slab nobody knows what is in front: leaves are on one half of the pixels, a chequered one, wood on the
    other, so that neither class gains from it.
    """
    for row in range(planes.shape[2]):
        wood_first = np.uint64(0x5555555555555555) << np.uint64(row & 1)
        for word in range(planes.shape[3]):
            covered, wood, leaves = np.uint64(0), np.uint64(0), np.uint64(0)
            for slab in range(SLABS):
                new_wood, new_leaves = planes[slab, BRANCHES, row, word], planes[slab, LEAVES, row, word]
                both = new_wood & new_leaves
                wood |= (new_wood ^ (both & ~wood_first)) & ~covered
                leaves |= (new_leaves ^ (both & wood_first)) & ~covered
                covered |= new_wood | new_leaves
            branch[row, word], foliage[row, word] = wood, leaves
