"""Vectors: three numbers that need no array, so that kernels make none for each leaf."""

from __future__ import annotations

import numpy as np
from numba import njit


@njit(inline="always")
def row(rows, k):
    """Row of (n, 3) as three numbers."""
    return rows[k, 0], rows[k, 1], rows[k, 2]


@njit(inline="always")
def dot(a, b):
    """Product of two vectors of three numbers."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@njit(inline="always")
def cross(a, b):
    """Vector at right angles to two."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@njit(inline="always")
def square_to(u, n):
    """Unit part of `u` at right angles to `n`; 0 when there is none."""
    along = dot(u, n)
    x, y, z = u[0] - along * n[0], u[1] - along * n[1], u[2] - along * n[2]
    length = np.sqrt(x * x + y * y + z * z)
    scale = 1.0 / length if length > 1e-6 * np.sqrt(dot(u, u)) and length > 1e-300 else 0.0
    return x * scale, y * scale, z * scale
