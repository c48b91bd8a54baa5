"""Crown: the envelope that limbs grow to and that their branches keep to."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.simplegen.directions import FAST, INNER

KNOTS = 5
BOTTOM, TOP, KEEP, TURN, DEPTH, LEFT, RIGHT = 0, 1, 2, 3, 4, 5, 5 + KNOTS
"""Places in the numbers (15,) of a crown: its ends in m; how strictly branches keep to it, in [0, 1]; what the angle of
the limbs gains from bottom to top, in rad; its depth by its width; half widths in m at evenly spaced heights."""
_SMALLEST_SHARE = np.float32(0.2)  # of a branch that begins outside
_ZERO, _HALF, _ONE, _TINY = np.float32(0.0), np.float32(0.5), np.float32(1.0), np.float32(1e-6)


@njit(**INNER)
def outside(crown, x, y, z):
    """Metres by which a point is outside of the crown, negative inside; left and right are joined by an ellipse."""
    tall = crown[TOP] - crown[BOTTOM]
    u = (z - crown[BOTTOM]) / tall
    inner = min(max(u, _ZERO), _ONE)
    at = inner * np.float32(KNOTS - 1)
    i = min(int(at), KNOTS - 2)
    f = at - np.float32(i)
    left = crown[LEFT + i] + (crown[LEFT + i + 1] - crown[LEFT + i]) * f
    right = crown[RIGHT + i] + (crown[RIGHT + i + 1] - crown[RIGHT + i]) * f
    r = math.sqrt(x * x + y * y)
    return r - _HALF * (left + right + (right - left) * x / (r + _TINY)) + abs(u - inner) * tall


@njit(**FAST)
def reach(crown, x, y, z, dx, dy, dz, longest):
    """Length at which a limb from a point on the trunk leaves the crown, at most `longest`."""
    low, high = _ZERO, longest
    for _ in range(8):
        middle = _HALF * (low + high)
        if outside(crown, x + dx * middle, y + dy * middle, z + dz * middle) > _ZERO:
            high = middle
        else:
            low = middle
    return _HALF * (low + high)


@njit(**INNER)
def kept(crown, x, y, z, dx, dy, dz, long):
    """Share that is kept of a branch of length `long`: up to where it leaves the crown, by one step of the secant."""
    end = outside(crown, x + dx * long, y + dy * long, z + dz * long)
    start = outside(crown, x, y, z)
    share = min(max(-start / max(end - start, _TINY), _SMALLEST_SHARE), _ONE)
    return _ONE + crown[KEEP] * (share - _ONE) if end > _ZERO else _ONE
