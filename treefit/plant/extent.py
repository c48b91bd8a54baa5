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
    rows = rows_of(plant)
    top, near, far = height_and_depth(*rows, np.float32(1.0), np.float32(0.0))
    left, right = sides(*rows)
    return Extent(float(top), float(left), float(right), float(near), float(far))


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"nnan", "nsz", "contract", "arcp", "reassoc"})
def height_and_depth(xyz, leaf_xyz, leaf_axis, leaf_normal, leaf_size, cos, sin):
    """Height of the plant, nearest and farthest vertex when it is turned by the angle of `cos` and `sin`, in metres."""
    px, py, pz = xyz
    top, near, far = np.float32(1e-6), np.float32(1e30), np.float32(-1e30)
    for i in range(len(px)):
        top = pz[i] if pz[i] > top else top
    for i in range(len(px)):
        depth = cos * py[i] - sin * px[i]
        near = depth if depth < near else near
        far = depth if depth > far else far
    ax, ay, az = leaf_axis
    nx, ny, _ = leaf_normal
    length, width = leaf_size
    lz, half = leaf_xyz[2], np.float32(0.5)
    for i in range(len(lz)):
        a, b = half * az[i] * length[i], half * (nx[i] * ay[i] - ny[i] * ax[i]) * width[i]
        tip = lz[i] + a + math.sqrt(a * a + b * b)
        top = tip if tip > top else top
    return top, near, far


@njit(cache=True, nogil=True, error_model="numpy")
def sides(xyz, leaf_xyz, leaf_axis, leaf_normal, leaf_size):
    """Least and greatest x of the plant, leaves included, in metres; the trunk base is at 0."""
    left, right = min(np.float32(0.0), xyz[0].min()), max(np.float32(0.0), xyz[0].max())
    ax, ay, az = leaf_axis
    _, ny, nz = leaf_normal
    for i in range(len(ax)):
        a = np.float32(0.5) * ax[i] * leaf_size[0][i]
        b = np.float32(0.5) * (ny[i] * az[i] - nz[i] * ay[i]) * leaf_size[1][i]
        x, reach = leaf_xyz[0][i] + a, math.sqrt(a * a + b * b)
        left, right = min(left, x - reach), max(right, x + reach)
    return left, right
