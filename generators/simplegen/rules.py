"""Rules of SimpleGen: what its kernels are told, and the arrays that they fill."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

STEM_FIELDS = 9  # position x y z, direction x y z, length, radius, parent vertex
SWAY, CHILD, LEAF = 1, 16, 64  # purposes of a joint's draws, first numbers of its children and of its leaves


class LevelRule(NamedTuple):
    """How the branches of one level grow and where their children begin; angles in rad, shares in [0, 1].

    In the kernels all of them are floats.
    """

    joints: int  # of the branching part; each carries children, at the last level leaves
    bare_joints: int  # of the bare part, on the trunk only
    start: float  # bare share
    whorl: int  # children at each joint, on the trunk only
    angle: float  # of the children
    length: float  # of the children, by that of their parent
    radius: float  # of the children, by that of their parent there
    taper: float
    upwards: float  # turn from base to tip
    child_upwards: float  # that of the children
    rightwards: float  # the same
    wobble: float
    variation: float  # of the children's length
    shortening: float  # of the children towards the tip
    shortest: float  # m; children shorter than this do not grow


class LeafRule(NamedTuple):
    """Where leaves are and how big."""

    angle: float  # rad, to the branch
    probability: float
    number: int  # at each joint of the last level
    length: float  # m
    width: float  # m


class Wood(NamedTuple):
    """Arrays of the vertices: x, y, z and radius (4, v), parent and level (2, v)."""

    numbers: NDArray[np.float32]
    integers: NDArray[np.int32]


class Stems(NamedTuple):
    """Branches of a level that are to grow: (STEM_FIELDS, m) and their keys (m,)."""

    fields: NDArray[np.float32]
    keys: NDArray[np.uint32]
