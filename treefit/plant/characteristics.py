"""Characteristics: numbers of a plant that the user may wish for, each a multiplier of the score (sec. 4)."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.plant.extent import extent_of
from treefit.plant.plant import Plant

VOXELS = 16  # voxels in the height of a plant, by which the volume of its crown is measured


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Characteristics:
    """Wanted values; None leaves a characteristic out."""

    vertices: int | None = Field(default=3000, ge=2)
    height: float | None = Field(default=None, gt=0)  # m
    width: float | None = Field(default=None, gt=0)  # m, seen from the front
    branch_density: float | None = Field(default=None, gt=0)  # m3 of wood in a m3 of crown
    leaf_density: float | None = Field(default=None, gt=0)  # m2 of leaf in a m3 of crown
    leaf_size: float | None = Field(default=None, gt=0)  # m, mean length

    @property
    def wanted(self) -> dict[str, float]:
        """Wanted values by name, those that are set."""
        return {name: value for name, value in vars(self).items() if name in MEASURES and value is not None}

    @property
    def sees_size(self) -> bool:
        """Whether the size in metres matters to any of them."""
        return bool(self.wanted.keys() - {"vertices"})

    def multipliers(self, plant: Plant) -> dict[str, float]:
        """C_mul = min(C_model, C_reference) / max(C_model, C_reference) by name, for those that are set."""
        return {name: ratio(MEASURES[name](plant), wanted) for name, wanted in self.wanted.items()}


def ratio(one: float, two: float) -> float:
    """Smaller by larger of two numbers that are not negative; 1 when equal."""
    return 1.0 if one == two else min(one, two) / max(one, two)


def vertices(plant: Plant) -> float:
    """Count of vertices in the branch graph."""
    return float(plant.n_vertices)


def height(plant: Plant) -> float:
    """Height in metres."""
    return extent_of(plant).height


def width(plant: Plant) -> float:
    """Width in metres, seen from the front."""
    return extent_of(plant).width


def branch_density(plant: Plant) -> float:
    """Volume of the wood by the volume of the crown."""
    return wood_volume(plant) / crown_volume(plant)


def leaf_density(plant: Plant) -> float:
    """Area of the leaves (ellipses) by the volume of the crown, in 1/m."""
    return float(math.pi / 4 * np.prod(plant.leaf_size, axis=1, dtype=np.float64).sum()) / crown_volume(plant)


def leaf_size(plant: Plant) -> float:
    """Mean length of the leaves in metres, 0 without leaves."""
    return float(plant.leaf_size[:, 0].mean()) if plant.n_leaves else 0.0


MEASURES = {
    "vertices": vertices, "height": height, "width": width, "branch_density": branch_density,
    "leaf_density": leaf_density, "leaf_size": leaf_size,
}  # fmt: skip
"""How each characteristic is measured, by name."""


def wood_volume(plant: Plant) -> float:
    """Volume of all segments as truncated cones, in cubic metres."""
    parent = plant.parent[1:]
    length = np.linalg.norm(plant.position[1:] - plant.position[parent], axis=1)
    end = plant.radius[1:].astype(np.float64)
    start = np.where(plant.level[1:] > plant.level[parent], end, plant.radius[parent])
    return float((math.pi / 3 * length * (start * start + start * end + end * end)).sum())


def crown_volume(plant: Plant) -> float:
    """Volume in cubic metres of the voxels, a 16th of the height wide, that hold leaves (without leaves: vertices)."""
    box = extent_of(plant)
    side = box.height / VOXELS
    points = plant.rows[1 if plant.n_leaves else 0]
    return int(count_voxels(points, np.float32(1.0 / side))) * side**3


@njit(cache=True, nogil=True, error_model="numpy")
def count_voxels(points, per_metre):
    """Count of the voxels that hold at least one of the points, given as rows x, y, z."""
    low, high = np.empty(3, np.int64), np.empty(3, np.int64)
    for axis, row in enumerate(points):
        low[axis] = int(math.floor(row.min() * per_metre))
        high[axis] = int(math.floor(row.max() * per_metre))
    shape = np.minimum(high - low + 1, 512)
    seen = np.zeros((shape[0], shape[1], shape[2]), np.bool_)
    count = 0
    for i in range(len(points[0])):
        a = min(int(math.floor(points[0][i] * per_metre)) - low[0], shape[0] - 1)
        b = min(int(math.floor(points[1][i] * per_metre)) - low[1], shape[1] - 1)
        c = min(int(math.floor(points[2][i] * per_metre)) - low[2], shape[2] - 1)
        if not seen[a, b, c]:
            seen[a, b, c] = True
            count += 1
    return count
