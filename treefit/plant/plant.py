"""Plant: the graph of branches and the leaves that a generator gives back; knows nothing of pictures."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant.look import Look, check_look

Floats = NDArray[np.float32]
Ints = NDArray[np.int32]
Row: TypeAlias = NDArray[np.float32]  # (v,) or (k,), contiguous
Rows: TypeAlias = tuple[tuple[Row, ...], tuple[Row, ...], tuple[Row, ...], tuple[Row, ...], tuple[Row, ...]]


@dataclass(frozen=True, eq=False)
class Plant:
    """A tree as arrays; z is up, the root stands at the origin, lengths in metres.

    Segment i runs from vertex parent[i] to vertex i. Its radius tapers from radius[parent[i]] to radius[i]
    within a stem; where a new stem begins (level[i] > level[parent[i]]) it is radius[i] at both ends. A stem
    that begins between two vertices of its parent has its first vertex there, on the parent's axis.
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
    look: Look | None = None  # what no mask sees; None is a round trunk and leaves without a wish
    complexity: float | None = None  # count of vertices as its generator counts them, when a mesh was read

    @classmethod
    def of_rows(cls, numbers: Floats, integers: Ints, leaves: Floats, cut: bool, look: Look | None = None) -> Plant:
        """Plant whose fields are views of rows as kernels fill them, nothing copied.

        `numbers` (4, v) are x, y, z, radius, `integers` (2, v) parent and level, `leaves` (11, k) position, axis,
        normal, length and width.
        """
        parent, level = integers
        position, axis, normal, size = leaves[:3].T, leaves[3:6].T, leaves[6:9].T, leaves[9:].T
        return cls(numbers[:3].T, numbers[3], parent, level, position, axis, normal, size, cut, look)

    @property
    def n_vertices(self) -> int:
        """Count of vertices of the branch graph."""
        return len(self.radius)

    @property
    def n_leaves(self) -> int:
        """Count of leaves."""
        return len(self.leaf_size)

    @cached_property
    def rows(self) -> Rows:
        """Position x y z, leaf position, axis, normal x y z, leaf length and width as contiguous rows.

        Nothing is copied where the arrays are structures of arrays, as those of fast generators are.
        """
        return (
            _rows(self.position), _rows(self.leaf_position), _rows(self.leaf_axis), _rows(self.leaf_normal),
            _rows(self.leaf_size),
        )  # fmt: skip


_SINGLE = np.dtype(np.float32)


def _rows(array: Floats) -> tuple[Row, ...]:
    rows = array.T
    if rows.dtype != _SINGLE or rows.strides[1] != _SINGLE.itemsize:
        rows = np.ascontiguousarray(rows, np.float32)
    return tuple(rows)


_NUMBERS = ("position", "leaf_position", "leaf_axis", "leaf_normal", "leaf_size", "radius")
_NEGATIVE_RADIUS, _BAD_ROOT, _BAD_ORDER = 64, 128, 256  # the bits below are those of _NUMBERS


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
    if plant.complexity is not None and not 0 < plant.complexity < np.inf:
        raise ValueError(f"plant: complexity must be a number over 0, got {plant.complexity}")
    if plant.look is not None:
        check_look(plant.look)
    wrong = _faults(plant.rows, plant.radius, plant.parent)
    if wrong == 0:
        return
    for bit, name in enumerate(_NUMBERS):
        if wrong >> bit & 1:
            raise ValueError(f"plant: {name} has NaN or infinite values")
    if wrong & _BAD_ROOT:
        raise ValueError("plant: parent must be -1 for vertex 0 and for no other")
    if wrong & _BAD_ORDER:
        raise ValueError("plant: parent[i] must be below i")
    raise ValueError("plant: radius must not be negative")


@njit(cache=True, nogil=True)
def _faults(rows, radius, parent):
    """Bits of what is wrong with the numbers of a plant."""
    wrong = 0
    position, leaf_position, leaf_axis, leaf_normal, leaf_size = rows
    for row in range(3):
        wrong |= _not_finite(position[row]) | _not_finite(leaf_position[row]) << 1
        wrong |= _not_finite(leaf_axis[row]) << 2 | _not_finite(leaf_normal[row]) << 3
    wrong |= (_not_finite(leaf_size[0]) | _not_finite(leaf_size[1])) << 4
    wrong |= _not_finite(radius) << 5
    in_order, least, negative = True, 0, False
    for i in range(1, len(parent)):
        in_order &= parent[i] < i
        least = min(least, parent[i])
        negative |= radius[i] < 0
    if negative or radius[0] < 0:
        wrong |= _NEGATIVE_RADIUS
    if parent[0] != -1 or least < 0:
        wrong |= _BAD_ROOT
    return wrong if in_order else wrong | _BAD_ORDER


@njit(cache=True, nogil=True, fastmath={"reassoc"})
def _not_finite(row):
    """1 when a number is NaN or infinite, else 0: nothing else times 0 is not 0."""
    zero = np.float32(0.0)
    for i in range(len(row)):
        zero += row[i] * np.float32(0.0)
    return 0 if zero == 0 else 1
