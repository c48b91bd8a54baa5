"""The naive view: shapes in space into a z-buffer, pixel by pixel; the reference by which the fast view is judged.

It shares no rule with the fast one: no bits, slabs, spans or lines, but a depth for every pixel, and float64. A segment
is a round stem seen as a tapered quad, a thick joint a ball, a leaf a flat polygon in space. Meant to be
read. It is compiled so that hundreds of plants at 512 rows take seconds, and so that the benchmark compares like with
like; tests/view/zbuffer.py is the same in plain numpy, pixel for pixel.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.mask import BRANCH, FOLIAGE, Mask
from treefit.plant import Plant
from treefit.plant.extent import extent_of
from treefit.view import Frame

THICK = 0.75  # radius in pixels over which the joints of a stem are round
CORNERS = 24  # of the polygon that stands for an elliptical leaf

Outline = NDArray[np.float64]
"""Corners (c, 2) of a convex leaf that is 2 long and 2 wide: along and across, from its middle."""


def zbuffer_mask(plant: Plant, frame: Frame, outline: Outline | None = None) -> Mask:
    """Mask (h, w) of a plant from the front; leaves are ellipses unless another `outline` is given."""
    size = extent_of(plant).height / frame.height
    mask = np.zeros((frame.height, frame.width), np.uint8)
    depth = np.full(mask.shape, np.inf)
    draw_stems(mask, depth, _pixels(plant.position, size), _pixels(plant.radius, size), plant.parent, plant.level)
    places, sizes = _pixels(plant.leaf_position, size), _pixels(plant.leaf_size, size)
    outline = ellipse(CORNERS) if outline is None else outline
    draw_leaves(mask, depth, places, _pixels(plant.leaf_axis), _pixels(plant.leaf_normal), sizes, outline)
    return mask


def ellipse(corners: int) -> Outline:
    """Regular polygon of that many `corners` with the area of the unit circle."""
    angle = 2 * np.pi * np.arange(corners) / corners
    radius = math.sqrt(2 * np.pi / (corners * math.sin(2 * np.pi / corners)))
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def _pixels(array: NDArray[np.float32], size: float = 1.0) -> NDArray[np.float64]:
    """`array` in units of `size` m, in rows of float64 whatever its layout was."""
    return np.ascontiguousarray(array, dtype=np.float64) / size


@njit(cache=True, nogil=True)
def draw_stems(mask, depth, position, radius, parent, level):
    """Draw every segment as a round stem, and a ball at its end where it is thick; lengths in pixels."""
    for i in range(1, len(parent)):
        p = parent[i]
        start, end = radius[i] if level[i] > level[p] else radius[p], radius[i]
        _stem(mask, depth, position[p], position[i], start, end)
        if end > THICK:
            _ball(mask, depth, position[i], end)


@njit(cache=True, nogil=True)
def draw_leaves(mask, depth, position, axis, normal, size, outline):
    """Draw every leaf as the flat `outline` in space between its attachment and its tip; lengths in pixels."""
    leaf, across = np.empty((len(outline), 3)), np.empty(3)
    for i in range(len(size)):
        for xyz in range(3):  # the cross product of normal and axis
            one, two = (xyz + 1) % 3, (xyz + 2) % 3
            across[xyz] = normal[i, one] * axis[i, two] - normal[i, two] * axis[i, one]
        for corner in range(len(outline)):
            along, aside = (1 + outline[corner, 0]) * size[i, 0] / 2, outline[corner, 1] * size[i, 1] / 2
            for xyz in range(3):
                leaf[corner, xyz] = position[i, xyz] + along * axis[i, xyz] + aside * across[xyz]
        _polygon(mask, depth, leaf)


@njit(cache=True, nogil=True)
def _stem(mask, depth, a, b, start, end):
    """Half-round stem from `a` to `b` (x, y away, z up) with the radii `start` and `end`."""
    reach = max(start, end)
    right, up = b[0] - a[0], b[2] - a[2]
    square = max(right * right + up * up, 1e-12)
    rows, columns = _box(mask, min(a[0], b[0]) - reach, max(a[0], b[0]) + reach, min(a[2], b[2]) - reach,
                         max(a[2], b[2]) + reach)  # fmt: skip
    for row in range(*rows):
        for column in range(*columns):
            x, z = _centre(mask, row, column)
            along = ((x - a[0]) * right + (z - a[2]) * up) / square  # 0 at a, 1 at b
            aside = ((x - a[0]) * up - (z - a[2]) * right) / math.sqrt(square)
            radius = start + (end - start) * along
            if 0 <= along <= 1 and abs(aside) <= radius:
                away = a[1] + (b[1] - a[1]) * along - math.sqrt(radius * radius - aside * aside)
                _put(mask, depth, row, column, away, BRANCH)


@njit(cache=True, nogil=True)
def _ball(mask, depth, middle, radius):
    """Ball around `middle`."""
    rows, columns = _box(mask, middle[0] - radius, middle[0] + radius, middle[2] - radius, middle[2] + radius)
    for row in range(*rows):
        for column in range(*columns):
            x, z = _centre(mask, row, column)
            room = radius * radius - (x - middle[0]) ** 2 - (z - middle[2]) ** 2
            if room >= 0:
                _put(mask, depth, row, column, middle[1] - math.sqrt(room), BRANCH)


@njit(cache=True, nogil=True)
def _polygon(mask, depth, corners):
    """Flat convex polygon with the `corners` (c, 3); Newell's formula gives its plane."""
    x0, y0, z0 = corners[0]
    left, right, low, high = x0, x0, z0, z0
    normal_x = normal_z = area = 0.0
    one = len(corners) - 1
    for two in range(len(corners)):
        x, y, z = corners[one, 0] - x0, corners[one, 1] - y0, corners[one, 2] - z0
        next_x, next_y, next_z = corners[two, 0] - x0, corners[two, 1] - y0, corners[two, 2] - z0
        area += (x - next_x) * (z + next_z)
        normal_x += (z - next_z) * (y + next_y)
        normal_z += (y - next_y) * (x + next_x)
        left, right = min(left, x0 + x), max(right, x0 + x)
        low, high = min(low, z0 + z), max(high, z0 + z)
        one = two
    if area == 0:  # seen from its edge
        return
    rows, columns = _box(mask, left, right, low, high)
    for row in range(*rows):
        for column in range(*columns):
            x, z = _centre(mask, row, column)
            if _inside(corners, x, z, area):
                _put(mask, depth, row, column, y0 - (normal_x * (x - x0) + normal_z * (z - z0)) / area, FOLIAGE)


@njit(cache=True, nogil=True)
def _inside(corners, x, z, area):
    """Whether a point lies on the inner side of every edge; the sign of `area` says which side that is."""
    one = len(corners) - 1
    for two in range(len(corners)):
        edge_x, edge_z = corners[two, 0] - corners[one, 0], corners[two, 2] - corners[one, 2]
        if ((x - corners[one, 0]) * edge_z - (z - corners[one, 2]) * edge_x) * area > 0:
            return False
        one = two
    return True


@njit(cache=True, nogil=True)
def _box(mask, left, right, low, high):
    """First and end of the rows and of the columns that a shape may touch."""
    height, width = mask.shape
    rows = max(0, int(height - high)), min(height, int(height - low) + 1)
    return rows, (max(0, int(width / 2 + left)), min(width, int(width / 2 + right) + 1))


@njit(cache=True, nogil=True)
def _centre(mask, row, column):
    """Place x, z of the centre of a pixel, from the foot of the trunk."""
    return column + 0.5 - mask.shape[1] / 2, mask.shape[0] - row - 0.5


@njit(cache=True, nogil=True)
def _put(mask, depth, row, column, away, label):
    """The nearest one is seen."""
    if away < depth[row, column]:
        depth[row, column] = away
        mask[row, column] = label
