"""Extent of a plant: height, width and depth of everything that is drawn, leaves included."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant.plant import Plant

Rows: TypeAlias = NDArray[np.float32]  # (3, v) or (3, k) or (2, k), contiguous


def rows_of(plant: Plant) -> tuple[Rows, Rows, Rows, Rows, Rows]:
    """Position, leaf position, axis, normal, size as contiguous rows; no copy where they are such already."""
    arrays = (plant.position, plant.leaf_position, plant.leaf_axis, plant.leaf_normal, plant.leaf_size)
    position, leaf_position, axis, normal, size = (np.ascontiguousarray(array.T, np.float32) for array in arrays)
    return position, leaf_position, axis, normal, size


@dataclass(frozen=True)
class Extent:
    """Height over the root, and how far the plant reaches along x (right) and y (depth), in metres."""

    height: float
    left: float
    right: float
    near: float
    far: float

    @property
    def width(self) -> float:
        """Width as seen from the front."""
        return self.right - self.left


def extent_of(plant: Plant) -> Extent:
    """Measure a plant as seen along +y."""
    return Extent(*(float(number) for number in extent(*rows_of(plant), np.float32(1.0), np.float32(0.0))))


@njit(cache=True, nogil=True)
def extent(xyz, leaf_xyz, leaf_axis, leaf_normal, leaf_size, cos, sin):
    """Height, left, right, near, far of the plant turned by the angle of `cos` and `sin`, in metres."""
    top, left, right = np.float32(1e-6), np.float32(0.0), np.float32(0.0)
    near, far = np.float32(1e30), np.float32(-1e30)
    for i in range(xyz.shape[1]):
        x, depth = cos * xyz[0, i] + sin * xyz[1, i], cos * xyz[1, i] - sin * xyz[0, i]
        top, near, far = max(top, xyz[2, i]), min(near, depth), max(far, depth)
        left, right = min(left, x), max(right, x)
    for i in range(leaf_xyz.shape[1]):
        long, wide = np.float32(0.5) * leaf_size[0, i], np.float32(0.5) * leaf_size[1, i]
        ax, ay, az = leaf_axis[0, i], leaf_axis[1, i], leaf_axis[2, i]
        nx, ny, nz = leaf_normal[0, i], leaf_normal[1, i], leaf_normal[2, i]
        a, b = az * long, (nx * ay - ny * ax) * wide
        top = max(top, leaf_xyz[2, i] + a + np.float32(math.sqrt(a * a + b * b)))
        a = (cos * ax + sin * ay) * long
        b = (cos * (ny * az - nz * ay) + sin * (nz * ax - nx * az)) * wide
        x, reach = cos * leaf_xyz[0, i] + sin * leaf_xyz[1, i] + a, np.float32(math.sqrt(a * a + b * b))
        left, right = min(left, x - reach), max(right, x + reach)
    return top, left, right, near, far
