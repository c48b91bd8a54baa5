"""Turning: directions with the axis of their bends, turned by angles given as cosine and sine; no branches."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from treefit.plant.compiling import INNER

_ZERO, _ONE, _SHORT = np.float32(0.0), np.float32(1.0), np.float32(1e-6)
_ARC = tuple(np.float32(x) for x in (1.5707288, -0.2121144, 0.0742610, -0.0187293))


@njit(**INNER)
def arccos(x):
    """Angle in rad whose cosine is `x`, to 7e-5 (Abramowitz and Stegun 4.4.45)."""
    y = min(abs(x), _ONE)
    angle = math.sqrt(_ONE - y) * (_ARC[0] + y * (_ARC[1] + y * (_ARC[2] + y * _ARC[3])))
    return angle if x >= _ZERO else np.float32(math.pi) - angle


@njit(**INNER)
def unit(x, y, z):
    """Vector of length 1: where errors of length would grow from turn to turn."""
    length = math.sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


@njit(**INNER)
def upper_side(dx, dy, dz, ax, ay, az):
    """Direction at right angles to both."""
    return dy * az - dz * ay, dz * ax - dx * az, dx * ay - dy * ax


@njit(**INNER)
def pitched(dx, dy, dz, ax, ay, az, c, s, p, q):
    """Direction d and axis a after a turn about a, down by (c, s), then about the upper side by (p, q)."""
    ux, uy, uz = upper_side(dx, dy, dz, ax, ay, az)
    ex, ey, ez = c * dx - s * ux, c * dy - s * uy, c * dz - s * uz
    return p * ex + q * ax, p * ey + q * ay, p * ez + q * az, p * ax - q * ex, p * ay - q * ey, p * az - q * ez


@njit(**INNER)
def rolled(x, y, z, kx, ky, kz):
    """Vector after a quarter turn around the unit vector k."""
    along = kx * x + ky * y + kz * z
    return ky * z - kz * y + along * kx, kz * x - kx * z + along * ky, kx * y - ky * x + along * kz


@njit(**INNER)
def attracted(dx, dy, dz, ax, ay, az, c, s):
    """Direction d and axis a after a turn of d to the sky by (c, s), in the upright plane of d."""
    side = math.sqrt(dx * dx + dy * dy)
    px, py = (dx + _SHORT) / (side + _SHORT), dy / (side + _SHORT)  # to the right where d is upright
    flat, up = side * c - dz * s, dz * c + side * s
    out = px * ax + py * ay
    turned = out * c - az * s - out
    return px * flat, py * flat, up, ax + turned * px, ay + turned * py, az * c + out * s


@njit(**INNER)
def placed(dx, dy, dz, ax, ay, az, p, q, c, s, fan):
    """Direction and axis of a child: turned around its parent's d by (p, q), or in a fan, then down by (c, s)."""
    ux, uy, uz = upper_side(dx, dy, dz, ax, ay, az)
    if fan:  # spread about the upper side
        ex, ey, ez = p * dx + q * ax, p * dy + q * ay, p * dz + q * az
        return c * ex - s * ux, c * ey - s * uy, c * ez - s * uz, p * ax - q * dx, p * ay - q * dy, p * az - q * dz
    hx, hy, hz = q * ax - p * ux, q * ay - p * uy, q * az - p * uz
    return (
        c * dx + s * hx, c * dy + s * hy, c * dz + s * hz, p * ax + q * ux, p * ay + q * uy, p * az + q * uz
    )  # fmt: skip


@njit(**INNER)
def about_vertical(x, y, z, c, s):
    """Vector after a turn about the vertical."""
    return c * x - s * y, s * x + c * y, z
