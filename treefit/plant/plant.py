"""Plant: the graph of branches and the leaves that a generator gives back; knows nothing of pictures."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Ints = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Plant:
    """A tree as arrays; z is up, the root stands at the origin, lengths in metres.

    Segment i runs from vertex parent[i] to vertex i. Its radius tapers from radius[parent[i]] to radius[i]
    within a stem; where a new stem begins (level[i] > level[parent[i]]) it is radius[i] at both ends.
    `(v, 3)` arrays may be views of contiguous x, y, z rows (structure of arrays).
    """

    position: Floats  # (v, 3) m
    radius: Floats  # (v,) m
    parent: Ints  # (v,), parent[i] < i, root -1
    level: Ints  # (v,), 0 is the trunk
    leaf_position: Floats  # (k, 3) m, where the leaf is attached
    leaf_axis: Floats  # (k, 3) unit, from the attachment to the tip
    leaf_normal: Floats  # (k, 3) unit, at right angles to the axis
    leaf_size: Floats  # (k, 2) length, width in m
    cut: bool = False  # True when the budget ended the growth

    @property
    def n_vertices(self) -> int:
        """Count of vertices of the branch graph."""
        return len(self.radius)

    @property
    def n_leaves(self) -> int:
        """Count of leaves."""
        return len(self.leaf_size)


def check_plant(plant: Plant) -> None:
    """Raise ValueError with the first thing that is wrong with `plant`: shapes, finiteness, order of parents."""
    v, k = plant.n_vertices, plant.n_leaves
    shapes = {
        "position": (v, 3), "parent": (v,), "level": (v,),
        "leaf_position": (k, 3), "leaf_axis": (k, 3), "leaf_normal": (k, 3), "leaf_size": (k, 2),
    }  # fmt: skip
    for name, shape in shapes.items():
        if getattr(plant, name).shape != shape:
            raise ValueError(f"plant: {name} must have shape {shape}, got {getattr(plant, name).shape}")
    if v < 2:
        raise ValueError(f"plant: needs at least 2 vertices, got {v}")
    for name in ("position", "radius", "leaf_position", "leaf_axis", "leaf_normal", "leaf_size"):
        array = getattr(plant, name)
        rows = array.T if array.ndim == 2 else array[None]
        quick = sum(float(np.dot(row, row)) for row in rows)  # NaN or infinite if a number is, or if one is huge
        if not math.isfinite(quick) and not np.isfinite(array).all():
            raise ValueError(f"plant: {name} has NaN or infinite values")
    if plant.parent[0] != -1 or plant.parent[1:].min() < 0:
        raise ValueError("plant: parent must be -1 for vertex 0 and for no other")
    if not ascending(plant.parent):
        raise ValueError("plant: parent[i] must be below i")
    if plant.radius.min() < 0:
        raise ValueError("plant: radius must not be negative")


@njit(cache=True, nogil=True)
def ascending(parent):
    """Whether every parent comes before its child."""
    in_order = True
    for i in range(len(parent)):
        in_order &= parent[i] < i
    return in_order
