"""Orthographic view of a plant as a mask, drawn by the bit-row rasteriser."""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.plant import Plant
from treefit.plant.extent import height_and_depth, rows_of
from treefit.view.frame import BitMask, Frame
from treefit.view.raster import composite, draw_branches, draw_leaves

SLABS, FINE_SLABS = 4, 32
"""Slabs of depth: for a search few are enough and stay in the nearest cache; a mask to be looked at has more."""


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class OrthographicView:
    """Looks along +y (x to the right, z up) at the plant turned by `azimuth` degrees; `resolution` rows a plant.

    `azimuths` sides, evenly around the plant, are seen for the score and their image similarities joined by `reduce`,
    so that a tree may not be one that only looks right from the front.
    """

    resolution: int = Field(default=128, ge=16, le=1024)
    azimuth: float = Field(default=0.0, ge=-360, le=360)
    azimuths: int = Field(default=1, ge=1, le=64)
    reduce: str = Field(default="mean", pattern="^(mean|best|worst)$")
    parallel: ClassVar[str] = "threads"

    def __call__(self, plant: Plant, frame: Frame) -> BitMask:
        """Bit rows of `plant` in `frame`; the highest point of the plant is the frame's top."""
        return self._seen(plant, frame, self.azimuth)

    def sides(self, plant: Plant, frame: Frame) -> list[BitMask]:
        """Bit rows of `plant` in `frame` from each of the `azimuths` sides, the front first."""
        return [self._seen(plant, frame, self.azimuth + 360.0 * i / self.azimuths) for i in range(self.azimuths)]

    def _seen(self, plant: Plant, frame: Frame, azimuth: float) -> BitMask:
        xyz, leaf_xyz, axis, normal, size = rows_of(plant)
        angle = math.radians(azimuth)
        cos, sin = np.float32(math.cos(angle)), np.float32(math.sin(angle))
        top, near, far = height_and_depth(xyz, leaf_xyz, axis, normal, size, cos, sin)
        slabs = SLABS if frame.height <= 128 else FINE_SLABS
        shape, window = (slabs, 2, frame.height, frame.words), (slabs, frame.height, frame.words)
        bits = np.zeros(math.prod(shape) + 1, np.uint64)  # one word more: spans touch the word behind them
        seen = (cos, sin, np.float32(frame.height / top), near, np.float32(slabs / (far - near + 1e-6)))
        draw_branches(bits, *window, xyz, plant.radius, plant.parent, plant.level, *seen)
        draw_leaves(bits, *window, leaf_xyz, axis, normal, size, *seen)
        branch, foliage = _empty(frame), _empty(frame)
        composite(bits[:-1].reshape(shape), branch, foliage)
        return BitMask(branch, foliage)


def _empty(frame: Frame) -> NDArray[np.uint64]:
    return np.empty((frame.height, frame.words), np.uint64)
