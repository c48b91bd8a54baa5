"""Unit vectors for the kernels of SimpleGen, in single precision and without branches."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from treefit.plant.compiling import INNER

_ZERO, _ONE, _HALF, _TINY = np.float32(0.0), np.float32(1.0), np.float32(0.5), np.float32(1e-12)
_SHORT = np.float32(1e-6)


@njit(**INNER)
def unit(x, y, z):
    """Return (x, y, z) at length 1; straight up for no length at all."""
    square = x * x + y * y + z * z
    n = _ONE / math.sqrt(max(square, _TINY))
    return (x * n, y * n, z * n) if square >= _TINY else (_ZERO, _ZERO, _ONE)


@njit(**INNER)
def frame(x, y, z):
    """Two unit vectors at right angles to the unit vector (x, y, z), and to each other."""
    sign = math.copysign(_ONE, z)
    a = -_ONE / (sign + z)
    b = x * y * a
    return _ONE + sign * x * x * a, sign * b, -sign * x, b, sign + y * y * a, -y


@njit(**INNER)
def aside(dx, dy, dz, cosine, sine, p, q, sum_x, sum_y):
    """Direction at an angle from (dx, dy, dz) and turned around it by that of `p`, `q` (cosine and sine).

    It is pushed away from (sum_x, sum_y), the sum of earlier ones, and leans as far to the side as before.
    """
    ux, uy, uz, wx, wy, wz = frame(dx, dy, dz)
    x = cosine * dx + sine * (p * ux + q * wx)
    y = cosine * dy + sine * (p * uy + q * wy)
    z = cosine * dz + sine * (p * uz + q * wz)
    side = math.sqrt(x * x + y * y)
    push = _HALF * side / (math.sqrt(sum_x * sum_x + sum_y * sum_y) + _HALF)
    x -= push * sum_x
    y -= push * sum_y
    stretch = side / (math.sqrt(x * x + y * y) + _SHORT)
    return unit(x * stretch, y * stretch, z)
