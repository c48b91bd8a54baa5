"""The square that the texture of a leaf fills, around the leaf of length 1: where a place of the leaf is in it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

MARGIN = 1 / 32
"""Share of the texture's side that is free around the leaf, so that no neighbour shines in at its border."""


@dataclass(frozen=True)
class LeafFrame:
    """Leaf places (x across from the midrib, y from the stalk to the tip) as places (u, v) in the unit square."""

    half_width: float  # of the leaf where it is broadest

    def uv(self, x: Floats, y: Floats) -> Floats:
        """Places (n, 2) in the texture of `x`, `y` (n,)."""
        inner = 1 - 2 * MARGIN
        return np.column_stack([0.5 + inner * x / (2 * self.half_width), MARGIN + inner * y])

    def xy(self, uv: Floats) -> Floats:
        """Places (n, 2) on the leaf of places in the texture."""
        inner = 1 - 2 * MARGIN
        return np.column_stack([(uv[:, 0] - 0.5) * 2 * self.half_width / inner, (uv[:, 1] - MARGIN) / inner])
