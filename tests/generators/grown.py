"""Trees of GEGen as they stand in the kernels: every joint and axis ever grown, lost ones too."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass

import numpy as np
import pytest
from numba import njit
from numpy.typing import NDArray

from generators.gegen import GEGen, generator
from generators.gegen.field import CELLS, light_at
from generators.gegen.scratch import Scratch
from generators.gegen.tree import AXIS, BORN, DEAD, LAST, X, Y, Z
from treefit.plant import Budget, Plant, Value

GENERATOR = GEGen()
BROAD = Budget(100_000, 400_000)
ROOM = Scratch()
OPEN: dict[str, Value] = {"light_right": 0.0, "neighbour_left": 0.0, "neighbour_right": 0.0, "lean": 0.0, "bend": 0.0}
"""A tree upright and alone, under light from above."""


@dataclass(frozen=True, eq=False)
class Grown:
    """A plant and the state that its growth left behind, turned: joint[Z] is all heights; lengths in internodes."""

    plant: Plant
    joint: NDArray[np.float32]  # (JOINT_FLOATS, n)
    node: NDArray[np.int32]  # (JOINT_INTS, n)
    axis: NDArray[np.float32]  # (AXIS_FLOATS, m)
    stem: NDArray[np.int32]  # (AXIS_INTS, m)
    light: NDArray[np.float32]  # (n,), of the joints

    @property
    def lost(self) -> NDArray[np.bool_]:
        """Which joints are on branches that were shed (n,)."""
        return self.stem[DEAD, self.node[AXIS]] > 0

    def leafy(self, years: int) -> NDArray[np.bool_]:
        """Which joints are of the last `years` years of growth of their axis, the root excepted (n,)."""
        young = self.stem[LAST, self.node[AXIS]] - self.node[BORN] < years
        young[0] = False
        return young


def grow(seed: int = 1, **values: Value) -> Grown:
    """Tree of the defaults and `values`, grown in a room that the generator itself does not use."""
    complete = GENERATOR.space.complete(values)
    if ROOM.tree:
        ROOM.tree[1][:, BORN] = 0  # so that the joints of this tree can be counted
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(generator, "_SCRATCH", ROOM)
        plant = GENERATOR(complete, seed, BROAD)
    joint, node, axis, stem, _ = ROOM.tree
    n = int(np.count_nonzero(node[:, BORN])) + 1  # the root is of the year 0
    axes = int(node[:n, AXIS].max()) + 1
    light = _lights(joint[:n], ROOM.light[1], np.float32(CELLS / float(complete["leader"])))
    # copies: a plant keeps hold of arrays that its whole budget would fit in
    return Grown(deepcopy(plant), *(part.T.copy() for part in (joint[:n], node[:n], axis[:axes], stem[:axes])), light)


def random_values(count: int, first: int = 0, **values: Value) -> list[dict[str, Value]]:
    """Values of random genomes, some of them as told."""
    genomes = np.random.default_rng(first).random((count, len(GENERATOR.space)))
    return [{**GENERATOR.space.decode(genome), **values} for genome in genomes]


@njit
def _lights(joint, shade, scale):
    light = np.empty(len(joint), np.float32)
    for i in range(len(light)):
        light[i] = light_at(shade, joint[i, X], joint[i, Y], joint[i, Z], scale)
    return light
