"""Crown: the envelope that limbs grow to and that their branches keep to."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant.compiling import FAST, INNER

KNOTS = 5
BOTTOM, TALL, KEEP, TURN, DEPTH, WIDTH, LOPSIDED = 0, 1, 2, 3, 4, 5, 5 + KNOTS
NUMBERS = 5 + 2 * KNOTS
"""Places in the numbers of a crown, and their count: its bottom and height in m; how strictly branches keep to it, in
[0, 1]; what the angle of the limbs gains from bottom to top, in rad; its depth by its width; then, as broken lines over
the height, half of its width and what the right side has more of it than the left, in m.

A broken line is its value at the bottom, its slope there, and what the slope gains at each knot between: evaluated
without looking anything up, which vector instructions like.
"""
_SMALLEST_SHARE = np.float32(0.2)  # of a branch that begins outside
_ZERO, _HALF, _ONE, _TWO, _THREE, _TINY = (np.float32(x) for x in (0.0, 0.5, 1.0, 2.0, 3.0, 1e-6))
_LAST = np.float32(KNOTS - 1)


def broken_line(values: NDArray[np.float64]) -> list[float]:
    """Numbers of the broken line through `values` (KNOTS,) at even distances of 1."""
    slopes = np.diff(values)
    return [float(values[0]), float(slopes[0]), *np.diff(slopes).tolist()]


@njit(**INNER)
def outside(crown, x, y, z):
    """Metres by which a point is outside of the crown, negative inside; left and right are joined by an ellipse."""
    u = (z - crown[BOTTOM]) / crown[TALL]
    inner = min(max(u, _ZERO), _ONE)
    at = inner * _LAST
    first, second, third = max(at - _ONE, _ZERO), max(at - _TWO, _ZERO), max(at - _THREE, _ZERO)
    width = crown[WIDTH] + crown[WIDTH + 1] * at
    width += crown[WIDTH + 2] * first + crown[WIDTH + 3] * second + crown[WIDTH + 4] * third
    lopsided = crown[LOPSIDED] + crown[LOPSIDED + 1] * at
    lopsided += crown[LOPSIDED + 2] * first + crown[LOPSIDED + 3] * second + crown[LOPSIDED + 4] * third
    r = math.sqrt(x * x + y * y)
    return r - width - lopsided * x / (r + _TINY) + abs(u - inner) * crown[TALL]


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
