"""PyrenderView: masks drawn by OpenGL through pyrender; slow, and a check of the fast rasteriser."""

from __future__ import annotations

from typing import ClassVar

from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.opengl import gl_missing
from treefit.plant import Plant
from treefit.view.frame import BitMask, Frame
from treefit.view.gl import gl_mask


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class PyrenderView:
    """Looks along +y at the plant; needs the libraries of offscreen OpenGL, ValueError without them."""

    resolution: int = Field(default=128, ge=16, le=1024)
    reduce: ClassVar[str] = "mean"
    parallel: ClassVar[str] = "processes"  # OpenGL contexts must not be shared by threads

    def __post_init__(self) -> None:
        missing = gl_missing()
        if missing is not None:
            raise ValueError(missing)

    def __call__(self, plant: Plant, frame: Frame) -> BitMask:
        """Bit rows of `plant` in `frame`."""
        return BitMask.pack(gl_mask(plant, frame.height, frame.half_width))

    def sides(self, plant: Plant, frame: Frame) -> list[BitMask]:
        """Bit rows from the front, the one side of this view."""
        return [self(plant, frame)]
