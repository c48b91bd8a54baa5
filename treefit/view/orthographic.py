"""Orthographic view of a plant as a mask, drawn by the bit-row rasteriser."""

from __future__ import annotations

from functools import cache
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.plant import Plant
from treefit.view.frame import BitMask, Frame
from treefit.view.raster import Scratch, draw

SLABS, FINE_SLABS = 8, 32
"""Slabs of depth: for a search few are enough and stay in the nearest cache; a mask to be looked at has more."""
_SCRATCH = Scratch()


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
        return self._seen(plant, frame, 1)[0]

    def sides(self, plant: Plant, frame: Frame) -> list[BitMask]:
        """Bit rows of `plant` in `frame` from each of the `azimuths` sides, the front first."""
        return self._seen(plant, frame, self.azimuths)

    def _seen(self, plant: Plant, frame: Frame, sides: int) -> list[BitMask]:
        """Bit rows from `sides` sides; where their count is even, each is drawn together with the one opposite."""
        xyz, position, axis, normal, size = plant.rows
        slabs = SLABS if frame.height <= 128 else FINE_SLABS
        planes = np.empty((sides, 2, frame.height, frame.words), np.uint64)
        scratch = _SCRATCH.room(slabs * 2 * frame.height * frame.words, plant.n_vertices)
        wood, foliage = (xyz, plant.radius, plant.parent, plant.level), (position, axis, normal, size)
        draw(scratch, slabs, _directions(self.azimuth, sides), sides % 2 == 0, wood, foliage, planes)
        return [BitMask(plane[0], plane[1]) for plane in planes]


@cache
def _directions(azimuth: float, sides: int) -> NDArray[np.float32]:
    """Cosines and sines (m, 2) of the turns of the sides that are drawn: all, or the first half of an even count."""
    drawn = sides if sides % 2 else sides // 2
    turns = np.radians(azimuth + np.arange(drawn) * (360.0 / sides))
    return np.column_stack([np.cos(turns), np.sin(turns)]).astype(np.float32)
