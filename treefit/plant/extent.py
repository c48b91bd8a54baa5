"""Extent of a plant: height, width and depth of everything that is drawn, leaves included."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numba import njit

from treefit.plant.plant import Plant


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
    rows = plant.rows
    top = height_of(rows[0][2], rows[1][2], *rows[2:])
    near, far = depth_of(rows[0][0], rows[0][1], np.float32(1.0), np.float32(0.0))
    left, right = sides(*rows)
    return Extent(float(top), float(left), float(right), float(near), float(far))


_HALF, _CHUNK = np.float32(0.5), 512
_FAST: dict[str, Any] = {
    "cache": True, "nogil": True, "error_model": "numpy", "fastmath": {"nnan", "nsz", "contract", "arcp", "reassoc"},
}  # fmt: skip
_INNER: dict[str, Any] = {**_FAST, "cache": False, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}


@njit(**_FAST)
def height_of(z, leaf_z, leaf_axis, leaf_normal, leaf_size):
    """Height of the plant in metres, leaves included."""
    top = np.float32(1e-6)
    for i in range(len(z)):
        top = max(top, z[i])
    ax, ay, az = leaf_axis
    nx, ny, _ = leaf_normal
    length, width = leaf_size
    for first in range(0, len(leaf_z), _CHUNK):
        end = min(first + _CHUNK, len(leaf_z))
        if _highest(leaf_z[first:end], length[first:end], width[first:end]) <= top:
            continue
        for i in range(first, end):
            a, b = _HALF * az[i] * length[i], _HALF * (nx[i] * ay[i] - ny[i] * ax[i]) * width[i]
            top = max(top, leaf_z[i] + a + math.sqrt(a * a + b * b))
    return top


@njit(**_INNER)
def _highest(z, length, width):
    """Height that no leaf passes, whatever its direction."""
    top = np.float32(0.0)
    for i in range(len(z)):
        top = max(top, z[i] + length[i] + width[i])
    return top


@njit(**_FAST)
def depth_of(x, y, cos, sin):
    """Nearest and farthest vertex when the plant is turned by the angle of `cos` and `sin`, in metres."""
    near, far = np.float32(1e30), np.float32(-1e30)
    for i in range(len(x)):
        depth = cos * y[i] - sin * x[i]
        near, far = min(near, depth), max(far, depth)
    return near, far


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
