"""The space around a bud: which way is the best-lit point."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.gegen.field import dark_at
from treefit.plant.compiling import INNER
from treefit.plant.streams import child_key, circle, two

REACH = np.float32(2.0)
"""Internodes from a bud at which it samples."""
PAIRS, SAMPLE = 2, 16
"""Pairs of opposite points, and the purpose of the draw of the first."""
_ZERO, _ONE, _TWO = np.float32(0.0), np.float32(1.0), np.float32(2.0)


@njit(**INNER)
def towards_light(shade, x, y, z, scale, key):
    """Way from a bud to the best-lit of sampled points: their mean by light, in lengths up to about 1.

    One best point of four random ones would jump at a small change, and pull where light is even; opposite points
    weighted by their light do neither. Light is that of their voxels, 1 / (1 + shade)^2.
    """
    sx = sy = sz = total = _ZERO
    for pair in range(PAIRS):
        ox, oy, oz = sphere(*two(child_key(key, SAMPLE + pair)))
        ahead = dark_at(shade, x + REACH * ox, y + REACH * oy, z + REACH * oz, scale)
        behind = dark_at(shade, x - REACH * ox, y - REACH * oy, z - REACH * oz, scale)
        ahead, behind, both = ahead * ahead, behind * behind, _ONE / (ahead * behind)
        both *= both
        more = REACH * (behind - ahead) * both
        total += (ahead + behind) * both
        sx, sy, sz = sx + more * ox, sy + more * oy, sz + more * oz
    by = _TWO / (total + np.float32(1e-6))
    return by * sx, by * sy, by * sz


@njit(**INNER)
def sphere(u, v):
    """Unit vector for two even draws in [0, 1), even over the sphere."""
    c, s = circle(u)
    up = _TWO * v - _ONE
    flat = math.sqrt(max(_ONE - up * up, _ZERO))
    return flat * c, flat * s, up
