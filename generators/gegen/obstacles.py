"""Obstacles: whether a bud may grow from one place to another, and the way along what it meets."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant.compiling import INNER


class World(NamedTuple):
    """What is around the tree; lengths in heights."""

    solid: bool  # whether there is any obstacle
    boxes: NDArray[np.float32]  # (m, 6) x y z from, x y z to
    mask: NDArray[np.uint8]  # (h, w), row 0 at the bottom, 1 is an obstacle
    extent: NDArray[np.float32]  # (6,) of the mask, as of a box
    taken: NDArray[np.uint8]  # markers that joints have taken, a bit each


ROOM = np.float32(0.25)
"""Internodes that joints keep from obstacles."""
LEAF_ROOM = np.float32(1e-3)
"""The same for leaves: no more than rounding needs."""
GROUND = np.float32(0.2)
"""Height in internodes under which nothing but the root is."""
_ZERO, _ONE, _TINY = np.float32(0.0), np.float32(1.0), np.float32(1e-9)


@njit(**INNER)
def blocked(world, x, y, z, dx, dy, dz, unit, room):
    """Whether the way from a point by (dx, dy, dz) comes within `room` of an obstacle.

    Lengths are in internodes, of which each is `unit` heights. The whole way is tested, so that no wall is too thin.
    """
    x, y, z, dx, dy, dz, room = x * unit, y * unit, z * unit, dx * unit, dy * unit, dz * unit, room * unit
    for box in world.boxes:
        enter, leave = _within(box, x, y, z, dx, dy, dz, room)
        if enter <= leave:
            return True
    if world.mask.shape[0] == 0:
        return False
    enter, leave = _within(world.extent, x, y, z, dx, dy, dz, room)
    if enter > leave:
        return False
    return _meets(world.mask, world.extent, x, z, dx, dz, enter, leave, room)


@njit(**INNER)
def around(world, x, y, z, dx, dy, dz, unit):
    """Unit direction that is free: the given one, or the nearest with one component less: (found, dx, dy, dz)."""
    best, bx, by, bz = _ZERO, dx, dy, dz
    for lost in range(-1, 3):  # -1: none; one loop, so that the test is compiled once
        sx, sy, sz = _ZERO if lost == 0 else dx, _ZERO if lost == 1 else dy, _ZERO if lost == 2 else dz
        whole = lost < 0  # as given, to the last bit
        length = _ONE if whole else np.float32(math.sqrt(sx * sx + sy * sy + sz * sz))
        if length <= best or length < np.float32(1e-3):
            continue
        sx, sy, sz = sx / length, sy / length, sz / length
        if (sz < 0 and z + sz < GROUND and lost >= 0) or blocked(world, x, y, z, sx, sy, sz, unit, ROOM):
            continue
        best, bx, by, bz = length, sx, sy, sz
        if lost < 0:
            break
    return best > _ZERO, bx, by, bz


@njit(**INNER)
def _within(box, x, y, z, dx, dy, dz, room):
    """First and last part of the way that is in `box`, wider by `room`; the first is larger when none is."""
    enter, leave = _ZERO, _ONE
    for side in range(3):
        place, step = (x, dx) if side == 0 else ((y, dy) if side == 1 else (z, dz))
        low, high = box[side] - room - place, box[side + 3] + room - place
        if abs(step) < _TINY:
            if low > _ZERO or high < _ZERO:
                return _ONE, _ZERO
            continue
        one, two = low / step, high / step
        enter, leave = max(enter, min(one, two)), min(leave, max(one, two))
    return enter, leave


@njit(**INNER)
def _meets(mask, extent, x, z, dx, dz, enter, leave, room):
    """Whether the way from `enter` to `leave` meets an obstacle of the picture, by all pixels that it crosses."""
    height, width = mask.shape
    across, up = np.float32(width) / (extent[3] - extent[0]), np.float32(height) / (extent[5] - extent[2])
    x, z, dx, dz = (x - extent[0]) * across, (z - extent[2]) * up, dx * across, dz * up
    beside, above = room * across, room * up
    one, two = x + enter * dx, x + leave * dx
    for i in range(max(int(min(one, two) - beside), 0), min(int(max(one, two) + beside), width - 1) + 1):
        first, last = enter, leave
        if abs(dx) > _TINY:
            one, two = (np.float32(i) - beside - x) / dx, (np.float32(i + 1) + beside - x) / dx
            first, last = max(first, min(one, two)), min(last, max(one, two))
        if first > last:
            continue
        one, two = z + first * dz, z + last * dz
        for j in range(max(int(min(one, two) - above), 0), min(int(max(one, two) + above), height - 1) + 1):
            if mask[j, i]:
                return True
    return False
