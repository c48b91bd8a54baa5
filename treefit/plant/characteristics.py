"""Characteristics: numbers of a plant that the user may wish for, each a multiplier of the score (sec. 4)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass as plain_dataclass
from dataclasses import replace
from functools import cached_property, partial
from typing import Annotated, Literal

import numpy as np
from numba import njit
from pydantic import AfterValidator, ConfigDict, Field, PlainValidator, ValidationInfo, field_validator
from pydantic.dataclasses import dataclass

from treefit.plant.bounds import Bounds, Wish, bounds_of, share_within
from treefit.plant.extent import extent_of
from treefit.plant.generator import Budget
from treefit.plant.plant import Plant
from treefit.plant.triangles import OUTLINE, SIDES, budget_of, check_outline, triangles

VOXELS = 16  # voxels in the height of a plant, by which the volume of its crown is measured
OVER = 4  # times the wanted count at which a plant is cut: its multiplier would be under a quarter


@plain_dataclass(frozen=True)
class OfHeight:
    """Wanted width as a share of the height: that of the plant, or of the nearest wanted one when it has none."""

    share: float


def _number(value: object) -> Bounds | None:
    return None if value is None else bounds_of(value)


def _count(value: object, least: float) -> Bounds | None:
    return None if value is None else bounds_of(value, whole=True, least=least)


def _width(value: object) -> Bounds | OfHeight | str | None:
    return value if value == "from_image" or isinstance(value, OfHeight) else _number(value)


Number = Annotated[Wish | Bounds | None, PlainValidator(_number)]
Width = Annotated[Wish | Bounds | OfHeight | Literal["from_image"] | None, PlainValidator(_width)]
Vertices = Annotated[Wish | Bounds | None, PlainValidator(partial(_count, least=2))]
Triangles = Annotated[Wish | Bounds | None, PlainValidator(partial(_count, least=8))]


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Characteristics:
    """Wanted values, ranges or limits; None leaves a characteristic out.

    `width` "from_image" is the width that the tree in the picture has when it is as high as `height` says.
    `sides` and `leaf_outline` are those of the mesh whose triangles are counted, as in AssetSettings.
    """

    vertices: Vertices = Bounds(3000, 3000)
    triangles: Triangles = None
    height: Number = None  # m
    width: Width = None  # m, seen from the front
    branch_density: Number = None  # m3 of wood in a m3 of crown
    leaf_density: Number = None  # m2 of leaf in a m3 of crown
    leaf_size: Number = None  # m, mean length
    sides: int = Field(default=SIDES, ge=3, le=32)
    leaf_outline: Annotated[str, AfterValidator(check_outline)] = OUTLINE

    @field_validator("width")
    @classmethod
    def _has_height(cls, width: Width, info: ValidationInfo) -> Width:
        if (width == "from_image" or isinstance(width, OfHeight)) and info.data.get("height") is None:
            raise ValueError("from_image needs a height, e.g. characteristics.height=12")
        return width

    @cached_property
    def bounds(self) -> dict[str, Bounds]:
        """Wanted numbers by name, those that are set; without a width that is relative to the height."""
        return {name: wish for name, wish in vars(self).items() if isinstance(wish, Bounds)}

    @property
    def wanted(self) -> dict[str, str]:
        """What is wished for, in words, by name: "at most 5000"."""
        relative = {} if self.width is None or "width" in self.bounds else {"width": "from_image"}
        return {name: str(wish) for name, wish in self.bounds.items()} | relative

    @property
    def sees_size(self) -> bool:
        """Whether the size in metres matters to any of them."""
        return bool(self.bounds.keys() - {"vertices", "triangles"})

    @cached_property
    def budget(self) -> Budget:
        """Counts at which a plant is so far over what is wanted that it need not be grown to its end."""
        budget = Budget()
        wanted = self.bounds.get("vertices")
        if wanted is not None and wanted.bounded:
            most = int(OVER * wanted.high)
            budget = Budget(max(most, 100), max(2 * most, 200))
        wanted = self.bounds.get("triangles")
        if wanted is not None and wanted.bounded:
            other = budget_of(OVER * wanted.high, self.sides, self.leaf_outline)
            budget = Budget(min(budget.vertices, other.vertices), min(budget.leaves, other.leaves))
        return budget

    def for_picture(self, share: float) -> Characteristics:
        """Return the same wishes for a picture whose tree is `share` of its height wide."""
        return replace(self, width=OfHeight(share)) if self.width == "from_image" else self

    def multipliers(self, plant: Plant) -> dict[str, float]:
        """C_mul = min(C_model, C_reference) / max(C_model, C_reference) by name, for those that are set.

        C_reference is the wanted number that is nearest to C_model; so within a range it is 1.
        """
        return {name: share_within(measure(plant), low, high) for name, measure, low, high in self._measures}

    @cached_property
    def _measures(self) -> list[tuple[str, Callable[[Plant], float], float, float]]:
        """Name, measure and bounds of what is set."""
        if self.width == "from_image":
            raise ValueError("characteristics.width: from_image is not known before there is a picture")
        measures: dict[str, Callable[[Plant], float]] = {
            **MEASURES, "triangles": partial(triangles, sides=self.sides, outline=self.leaf_outline),
        }  # fmt: skip
        found = [(name, measures[name], wish.low, wish.high) for name, wish in self.bounds.items()]
        if isinstance(self.width, OfHeight):
            relative = partial(width_by_height, share=self.width.share, height=self.bounds["height"])
            found.append(("width", relative, 1, 1))
        return found


def vertices(plant: Plant) -> float:
    """Count of vertices in the branch graph, or the complexity that the plant of a mesh declares."""
    return float(plant.n_vertices) if plant.complexity is None else plant.complexity


def height(plant: Plant) -> float:
    """Height in metres."""
    return extent_of(plant).height


def width(plant: Plant) -> float:
    """Width in metres, seen from the front."""
    return extent_of(plant).width


def width_by_height(plant: Plant, share: float, height: Bounds) -> float:
    """Width by what it is at `share` of the height, or of the nearest one in the bounds `height`."""
    extent = extent_of(plant)
    return extent.width / (share * min(max(extent.height, height.low), height.high))


def branch_density(plant: Plant) -> float:
    """Volume of the wood by the volume of the crown."""
    return wood_volume(plant) / crown_volume(plant)


def leaf_density(plant: Plant) -> float:
    """Area of the leaves (ellipses) by the volume of the crown, in 1/m."""
    return float(math.pi / 4 * np.prod(plant.leaf_size, axis=1, dtype=np.float64).sum()) / crown_volume(plant)


def leaf_size(plant: Plant) -> float:
    """Mean length of the leaves in metres, 0 without leaves."""
    return float(plant.leaf_size[:, 0].mean()) if plant.n_leaves else 0.0


MEASURES: dict[str, Callable[[Plant], float]] = {
    "vertices": vertices, "triangles": triangles, "height": height, "width": width, "branch_density": branch_density,
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
