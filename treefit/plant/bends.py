"""Bends: the smooth curve through the rings of one stem, and how many straight pieces show it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant.compiling import INNER

PIECES = 4
"""Straight pieces that stand for the curve between two vertices at most."""

ROUNDING = 0.4

Numbers = NDArray[np.float64]


class Bend(NamedTuple):
    """Room for the curve of one stem of n segments: a spline whose parameter is the root of their length."""

    unit: Numbers  # (n, 3) directions of the segments
    length: Numbers  # (n,) m
    speed: Numbers  # (n + 1, 3) derivatives at the rings
    taper: Numbers  # (n + 1,) slopes of the radius along the stem at the rings


@njit(**INNER)
def measure(centre, low, n, bend):
    """Fill directions and lengths of the `n` segments from ring `low` on."""
    for k in range(n):
        square = 0.0
        for axis in range(3):
            bend.unit[k, axis] = centre[low + k + 1, axis] - centre[low + k, axis]
            square += bend.unit[k, axis] ** 2
        bend.length[k] = np.sqrt(square)
        for axis in range(3):
            bend.unit[k, axis] /= bend.length[k]


@njit(**INNER)
def curve(bend, n, start, guided):
    """Fill the speeds of the centripetal Catmull-Rom spline; its ends are not curved.

    At a ring it has the direction halfway between those of the two segments. A `guided` one begins along `start` (3,).
    """
    unit, length, speed = bend.unit, bend.length, bend.speed
    for i in range(1, n):
        before, after = np.sqrt(length[i - 1]), np.sqrt(length[i])
        for axis in range(3):
            speed[i, axis] = before * after / (before + after) * (unit[i - 1, axis] + unit[i, axis])
    first, last = np.sqrt(length[0]), np.sqrt(length[n - 1])
    for axis in range(3):
        speed[0, axis] = first * (start[axis] if guided else unit[0, axis])
        if n > 1 and not guided:
            speed[0, axis] = 1.5 * speed[0, axis] - 0.5 * speed[1, axis]
        speed[n, axis] = last * unit[n - 1, axis]
        if n > 1 or guided:
            speed[n, axis] = 1.5 * speed[n, axis] - 0.5 * speed[n - 1, axis]


@njit(**INNER)
def tapered(radius, low, n, bend):
    """Fill the tapers: a monotone cubic of the radius between the rings (Fritsch and Butland 1984)."""
    length, taper = bend.length, bend.taper
    before = 0.0
    for k in range(n):
        slope = (radius[low + k + 1] - radius[low + k]) / length[k]
        if k == 0:
            taper[0] = slope
        elif before * slope > 0:
            w = (length[k - 1] + 2 * length[k]) / (3 * (length[k - 1] + length[k]))
            taper[k] = before * slope / (w * slope + (1 - w) * before)
        else:
            taper[k] = 0.0
        before = slope
    taper[n] = before


@njit(**INNER)
def rounded(radius, low, n, bend, smooth):
    """Fill `smooth` (r,) from ring `low` on: the radius, a part of the way to the line between the rings beside it.

    So a stem that loses much of its wood at a fork has no shoulder there; where it widens towards a foot it is as told.
    """
    smooth[low], smooth[low + n] = radius[low], radius[low + n]
    for k in range(1, n):
        before, after, i = bend.length[k - 1], bend.length[k], low + k
        line = (after * radius[i - 1] + before * radius[i + 1]) / (before + after)
        smooth[i] = radius[i] - ROUNDING * max(radius[i] - line, 0.0)


@njit(**INNER)
def pieces(radius, i, k, bend, tolerance):
    """Count of straight pieces, up to PIECES, that are within `tolerance` m of the curve on segment k from ring i."""
    unit, speed, taper = bend.unit, bend.speed, bend.taper
    along_start = along_end = start = end = 0.0
    root = np.sqrt(bend.length[k])
    for axis in range(3):
        along_start += root * speed[k, axis] * unit[k, axis]
        along_end += root * speed[k + 1, axis] * unit[k, axis]
    for axis in range(3):
        start += (root * speed[k, axis] - along_start * unit[k, axis]) ** 2
        end += (root * speed[k + 1, axis] - along_end * unit[k, axis]) ** 2
    slope = (radius[i + 1] - radius[i]) / bend.length[k]
    swell = bend.length[k] * (abs(taper[k] - slope) + abs(taper[k + 1] - slope))
    off = (np.sqrt(start) + np.sqrt(end) + swell) / 8
    return min(max(int(np.ceil(np.sqrt(off / tolerance))), 1), PIECES)


@njit(**INNER)
def point(centre, radius, i, k, bend, t, place):
    """Fill `place` (3,) of the curve at the share t of segment k, which begins at ring i; return the radius there."""
    h = t * t * (3 - 2 * t)
    d0, d1 = t * (1 - t) * (1 - t), t * t * (t - 1)
    root = np.sqrt(bend.length[k])
    for axis in range(3):
        place[axis] = (
            (1 - h) * centre[i, axis] + h * centre[i + 1, axis]
            + root * (d0 * bend.speed[k, axis] + d1 * bend.speed[k + 1, axis])
        )  # fmt: skip
    return (1 - h) * radius[i] + h * radius[i + 1] + bend.length[k] * (d0 * bend.taper[k] + d1 * bend.taper[k + 1])
