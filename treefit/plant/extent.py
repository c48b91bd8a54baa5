"""Extent of a plant: height, width and depth of everything that is drawn, leaves included."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant.plant import Plant

Row: TypeAlias = NDArray[np.float32]  # (v,) or (k,), contiguous
Rows: TypeAlias = tuple[tuple[Row, ...], tuple[Row, ...], tuple[Row, ...], tuple[Row, ...], tuple[Row, ...]]


def rows_of(plant: Plant) -> Rows:
    """Position x y z, leaf position, axis, normal x y z, leaf length and width as contiguous rows.

    Nothing is copied where the arrays of the plant are structures of arrays, as those of fast generators are.
    """
    return (
        _rows(plant.position), _rows(plant.leaf_position), _rows(plant.leaf_axis), _rows(plant.leaf_normal),
        _rows(plant.leaf_size),
    )  # fmt: skip


def _rows(array: NDArray[np.float32]) -> tuple[Row, ...]:
    return tuple(np.ascontiguousarray(row, np.float32) for row in array.T)


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
    top, left, right, near, far = extent(*rows_of(plant), np.float32(1.0), np.float32(0.0))
    return Extent(float(top), float(left), float(right), float(near), float(far))


@njit(cache=True, nogil=True, error_model="numpy")
def extent(xyz, leaf_xyz, leaf_axis, leaf_normal, leaf_size, cos, sin):
    """Height, left, right, near, far of the plant turned by the angle of `cos` and `sin`, in metres."""
    top, left, right = np.float32(1e-6), np.float32(0.0), np.float32(0.0)
    near, far = np.float32(1e30), np.float32(-1e30)
    for i in range(len(xyz[0])):
        x, depth = cos * xyz[0][i] + sin * xyz[1][i], cos * xyz[1][i] - sin * xyz[0][i]
        top, near, far = max(top, xyz[2][i]), min(near, depth), max(far, depth)
        left, right = min(left, x), max(right, x)
    for i in range(len(leaf_size[0])):
        long, wide = np.float32(0.5) * leaf_size[0][i], np.float32(0.5) * leaf_size[1][i]
        ax, ay, az = leaf_axis[0][i], leaf_axis[1][i], leaf_axis[2][i]
        nx, ny, nz = leaf_normal[0][i], leaf_normal[1][i], leaf_normal[2][i]
        a, b = az * long, (nx * ay - ny * ax) * wide
        top = max(top, leaf_xyz[2][i] + a + np.float32(math.sqrt(a * a + b * b)))
        a = (cos * ax + sin * ay) * long
        b = (cos * (ny * az - nz * ay) + sin * (nz * ax - nx * az)) * wide
        x, reach = cos * leaf_xyz[0][i] + sin * leaf_xyz[1][i] + a, np.float32(math.sqrt(a * a + b * b))
        left, right = min(left, x - reach), max(right, x + reach)
    return top, left, right, near, far
