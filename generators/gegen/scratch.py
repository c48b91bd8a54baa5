"""Memory of the kernels of GEGen, one of each thread, kept from plant to plant."""

from __future__ import annotations

import threading
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from generators.gegen.field import HIGH, WIDE
from generators.gegen.markers import BYTES
from generators.gegen.tree import AXIS_FLOATS, AXIS_INTS, JOINT_FLOATS, JOINT_INTS

Arrays: TypeAlias = tuple[NDArray[np.generic], ...]


class Scratch(threading.local):
    """Room for a growing tree, for the light around it and for what one axis shares."""

    def __init__(self) -> None:
        self.joints = 0
        self.tree: Arrays = ()
        self.shares: Arrays = ()
        source, own, still, total = (np.zeros((HIGH, WIDE, WIDE), np.float32) for _ in range(4))
        rows, box, taken = np.zeros((2 * WIDE, WIDE + 2), np.float32), np.zeros(5, np.int64), np.zeros(BYTES, np.uint8)
        self.light: Arrays = (source, own, still, total, rows, box, taken)

    def room(self, joints: int) -> tuple[Arrays, Arrays, Arrays]:
        """Return its arrays, with room for `joints` and for as many axes."""
        if self.joints < joints:
            self.joints = joints
            self.tree = (
                np.zeros((joints, JOINT_FLOATS), np.float32), np.zeros((joints, JOINT_INTS), np.int32),
                np.zeros((joints, AXIS_FLOATS), np.float32), np.zeros((joints, AXIS_INTS), np.int32),
                np.zeros(joints, np.uint32),
            )  # fmt: skip
            self.shares = (np.zeros(joints, np.int32), np.zeros(joints, np.float32), np.zeros(joints, np.int32))
        return self.tree, self.light, self.shares
