"""Frame: where a plant stands in its picture; the gallery lines pictures up by it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

TREE_SHARE = 0.84  # of the picture's height, from the base to the highest leaf
BASE_SHARE = 0.90  # of the picture's height, from the top to the base of the trunk
_SIDE_ROOM = 0.07  # of the picture's height, left and right of the plant
_NARROWEST, _WIDEST = 0.62, 2.5  # widths in picture heights


@dataclass(frozen=True)
class Frame:
    """An orthographic front view: camera along +y, x to the right, z up; trunk base in the middle column."""

    height: int  # pixels
    width: int  # pixels
    scale: float  # pixels a metre

    @property
    def base(self) -> float:
        """Row of the trunk base."""
        return BASE_SHARE * self.height

    def project(self, place: NDArray[np.float32]) -> NDArray[np.float32]:
        """Column, row, depth (n, 3) of `place` (n, 3) in metres."""
        column = self.width / 2 + self.scale * place[:, 0]
        return np.column_stack([column, self.base - self.scale * place[:, 2], place[:, 1]]).astype(np.float32)

    def finer(self, times: int) -> Frame:
        """Return the same view with `times` as many rows and columns."""
        return Frame(self.height * times, self.width * times, self.scale * times)


def frame_plant(place: NDArray[np.float32], size: int | tuple[int, int]) -> Frame:
    """Return the frame that shows the points `place` (n, 3); an int is the height and the width follows the plant.

    With (h, w) a plant that is too wide is shown smaller, its base stays in its row.
    """
    tall = max(float(place[:, 2].max()), 1e-6)
    reach = float(np.abs(place[:, 0]).max())
    if isinstance(size, tuple):
        height, width = size
    else:
        height = size
        wanted = 2 * (reach / tall * TREE_SHARE + _SIDE_ROOM)
        width = 2 * round(height * min(max(wanted, _NARROWEST), _WIDEST) / 2)
    if height < 8 or width < 8:
        raise ValueError(f"picture must be 8 x 8 pixels or larger, got {height} x {width}")
    room = width / 2 - min(_SIDE_ROOM * height, 0.1 * width)
    scale = min(TREE_SHARE * height / tall, room / max(reach, 1e-6))
    return Frame(height, width, scale)
