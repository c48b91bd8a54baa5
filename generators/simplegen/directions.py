"""Unit vectors for the kernels of SimpleGen, in single precision."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

_ONE, _TINY = np.float32(1.0), np.float32(1e-12)


@njit(inline="always", error_model="numpy")
def unit(x, y, z):
    """Return (x, y, z) at length 1; straight up for no length at all."""
    square = x * x + y * y + z * z
    if square < _TINY:
        return np.float32(0.0), np.float32(0.0), _ONE
    n = _ONE / math.sqrt(square)
    return x * n, y * n, z * n


@njit(inline="always", error_model="numpy")
def frame(x, y, z):
    """Two unit vectors at right angles to the unit vector (x, y, z), and to each other."""
    sign = math.copysign(_ONE, z)
    a = -_ONE / (sign + z)
    b = x * y * a
    return _ONE + sign * x * x * a, sign * b, -sign * x, b, sign + y * y * a, -y
