"""The growing tree: joints and axes as flat arrays, parents before children; lengths in internodes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

X, Y, Z, DX, DY, DZ, MAIN, SIDE, WEIGHT, STORE, WOOD = range(11)
"""Numbers of a joint: place, direction of growth, light gathered beyond it on its axis and to its side, weight of its
lateral buds, resource that they keep for next year, wood as the sum of the pipes that run through it."""
JOINT_FLOATS = 11

PARENT, AXIS, NEXT, FIRST, LATERALS, BORN, ORDER, PATH, BUDS = range(9)
"""Whole numbers of a joint: joint before it, its axis, joint after it on its axis, the first of its lateral axes and
their count, year of its growth, place on its axis, joints from the trunk, lateral buds that still wait."""
JOINT_INTS = 9

GATHERED, GIVEN, SIZE, OUT_X, OUT_Y, OUT_Z, KEPT = range(7)
"""Numbers of an axis, all branches on it included: light gathered, resource given this year, joints; then its own first
direction, and the resource that its tip keeps for next year."""
AXIS_FLOATS = 7

BASE, HEAD, TIP, LEVEL, START, LAST, UNITS, AGED, DEAD = range(9)
"""Whole numbers of an axis: joint that bears it, its first and its last joint, level, first and last year of growth,
internodes that it shall grow this year, 1 when its tip grows no more, 1 when it was shed."""
AXIS_INTS = 9


class Tree(NamedTuple):
    """Numbers of joints and axes, a row each."""

    joint: NDArray[np.float32]  # (n, JOINT_FLOATS)
    node: NDArray[np.int32]  # (n, JOINT_INTS)
    axis: NDArray[np.float32]  # (m, AXIS_FLOATS)
    stem: NDArray[np.int32]  # (m, AXIS_INTS)
    key: NDArray[np.uint32]  # (m,)
