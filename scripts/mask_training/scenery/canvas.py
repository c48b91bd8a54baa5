"""Canvas: the picture that is painted from far to near, and where it is land and no longer sky."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PIL import Image as Pillow
from PIL import ImageDraw

from scripts.mask_training.scenery.arrays import Colour, Field, Floats, Image
from scripts.mask_training.scenery.layers import darken, over_colour, over_picture
from scripts.mask_training.scenery.splats import dab

FINE = 3
"""Shapes are drawn so many times larger, for soft edges."""


@dataclass(frozen=True, eq=False)
class Canvas:
    """`paint` (size, size, 4): display colour and the share of land."""

    paint: Floats

    @classmethod
    def blank(cls, size: int) -> Canvas:
        """A black sky."""
        return cls(np.zeros((size, size, 4), np.float32))

    @property
    def size(self) -> int:
        """Pixels of a side."""
        return len(self.paint)

    @property
    def rgb(self) -> Image:
        """View of the colours."""
        return self.paint[..., :3]

    @property
    def land(self) -> Field:
        """View of the share of land."""
        return self.paint[..., 3]

    def lay(self, colour: Floats | Colour, opacity: Field) -> None:
        """Lay land of `colour`, one or a picture, over all with `opacity` (h, w)."""
        chosen = np.asarray(colour, np.float32)
        if chosen.ndim == 3:
            over_picture(self.paint, chosen, opacity.astype(np.float32, copy=False))
        else:
            over_colour(self.paint, chosen, opacity.astype(np.float32, copy=False))

    def tone(self, factor: Field | Floats) -> None:
        """Make colours lighter or darker by `factor` (h, w) or (h, w, 3)."""
        if factor.ndim == 2:
            darken(self.paint, factor.astype(np.float32, copy=False))
        else:
            self.rgb[...] *= factor

    def dabs(self, place: Floats, size: Floats, turn: Floats, colour: Floats, opacity: float = 1.0) -> None:
        """Paint ellipses at `place` (n, 2), column and row, with half axes `size` (n, 2), in their order."""
        count = len(place)
        full = np.full((count, 1), opacity, np.float32)
        numbers = np.hstack([place, size, np.reshape(turn, (count, 1)), colour, full])
        dab(self.paint, np.ascontiguousarray(numbers, np.float32))


class Stencil:
    """Shapes drawn FINE times larger in one tone, as an opacity of the size of the picture."""

    def __init__(self, size: int) -> None:
        self.size = size
        self._sheet = Pillow.new("L", (size * FINE, size * FINE))
        self._pen = ImageDraw.Draw(self._sheet)

    def polygon(self, points: Floats | list[tuple[float, float]], tone: int = 255) -> None:
        """Fill a polygon of (column, row)."""
        self._pen.polygon([(float(x) * FINE, float(y) * FINE) for x, y in points], fill=tone)

    def box(self, left: float, top: float, right: float, bottom: float, tone: int = 255) -> None:
        """Fill a box."""
        self.polygon([(left, top), (right, top), (right, bottom), (left, bottom)], tone)

    def line(self, points: list[tuple[float, float]], width: float, tone: int = 255) -> None:
        """Draw a line of `width` pixels."""
        scaled = [(x * FINE, y * FINE) for x, y in points]
        self._pen.line(scaled, fill=tone, width=max(1, round(width * FINE)), joint="curve")

    def oval(self, x: float, y: float, a: float, b: float, tone: int = 255) -> None:
        """Fill an ellipse around (x, y) with half axes a and b."""
        self._pen.ellipse([(x - a) * FINE, (y - b) * FINE, (x + a) * FINE, (y + b) * FINE], fill=tone)

    def opacity(self) -> Field:
        """Share (size, size) of each pixel that is drawn."""
        small = self._sheet.reduce(FINE)
        share: Field = np.asarray(small, np.float32) / 255
        return share
