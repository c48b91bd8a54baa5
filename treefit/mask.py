"""Mask: the common picture of plants and photographs that the similarity compares (sec. 4)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

BACKGROUND, BRANCH, FOLIAGE = 0, 1, 2

Mask = NDArray[np.uint8]
"""(h, w) uint8, row 0 on top, values BACKGROUND, BRANCH, FOLIAGE."""

PALETTE = ((255, 255, 255), (121, 85, 61), (76, 153, 60))
"""Colours (r, g, b) in which a mask is shown, by class."""


def check_mask(mask: NDArray[np.generic]) -> Mask:
    """Return `mask` as a Mask; ValueError when it is not (h, w) with values 0, 1, 2."""
    if mask.ndim != 2 or mask.size == 0:
        raise ValueError(f"mask must be (h, w) and not empty, got shape {mask.shape}")
    values = np.unique(mask)
    if not np.isin(values, (BACKGROUND, BRANCH, FOLIAGE)).all():
        shown = ", ".join(str(value) for value in values[:8])
        raise ValueError(f"mask pixel values must be 0 background, 1 branch, 2 foliage; got {shown}")
    return np.ascontiguousarray(mask, dtype=np.uint8)
