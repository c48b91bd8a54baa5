"""Picture: pixels as the extractors get them; knows nothing of files or masks."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

Rgb = NDArray[np.uint8]
"""(h, w, 3) uint8, row 0 on top."""

Alpha = NDArray[np.uint8]
"""(h, w) uint8, 0 transparent, 255 opaque."""

Region = NDArray[np.bool_]
"""(h, w) bool, True inside."""


@dataclass(frozen=True, eq=False)
class Picture:
    """Pixels of one picture, upright, transparent parts already white.

    `alpha` is None when every pixel is opaque; `notes` say what was done on reading that a user may not expect.
    """

    rgb: Rgb
    alpha: Alpha | None = None
    notes: tuple[str, ...] = ()
    path: Path | None = None

    def __post_init__(self) -> None:
        if self.rgb.ndim != 3 or self.rgb.shape[2] != 3 or self.rgb.dtype != np.uint8 or self.rgb.size == 0:
            raise ValueError(f"picture: rgb must be (h, w, 3) uint8, got {self.rgb.shape} {self.rgb.dtype}")
        if self.alpha is not None and (self.alpha.shape != self.shape or self.alpha.dtype != np.uint8):
            raise ValueError(f"picture: alpha must be {self.shape} uint8, got {self.alpha.shape} {self.alpha.dtype}")

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width in pixels."""
        return self.rgb.shape[0], self.rgb.shape[1]


def shrink(picture: Picture, size: int) -> Picture:
    """`picture` with its longer side at most `size` pixels, averaged over areas."""
    longest = max(picture.shape)
    if longest <= size:
        return picture
    height, width = (max(1, round(side * size / longest)) for side in picture.shape)
    alpha = None if picture.alpha is None else _resize(picture.alpha, width, height)
    return Picture(_resize(picture.rgb, width, height), alpha, picture.notes, picture.path)


def cut_out(picture: Picture, rows: slice, columns: slice) -> Picture:
    """The part of `picture` in `rows` and `columns`."""
    alpha = None if picture.alpha is None else np.ascontiguousarray(picture.alpha[rows, columns])
    return Picture(np.ascontiguousarray(picture.rgb[rows, columns]), alpha, picture.notes, picture.path)


def _resize(pixels: NDArray[np.uint8], width: int, height: int) -> NDArray[np.uint8]:
    resized = Image.fromarray(pixels).resize((width, height), Image.Resampling.BOX)
    return np.asarray(resized, dtype=np.uint8)
