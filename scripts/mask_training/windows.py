"""Windows: which part of a painted scene a view shows; photographs frame their tree closer than scenes do."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from treefit.mask import BACKGROUND

Corners = NDArray[np.float64]
"""(n, 2) x and y of points in -1 (left, top) .. 1 (right, bottom)."""

FRAMED = 0.6
"""Share of the views that show the whole tree; the others may cut it, as photographs do."""
LEAST = 0.6
"""Least side of a window: enlarged further, a scene is blurred."""
LEAST_CUT = 0.75
MOST_STRETCH = 1.4


def windows(classes: NDArray[np.uint8], aspect: float, rng: np.random.Generator) -> tuple[Corners, Corners]:
    """Middles and half sides of windows into scenes of `classes` (n, s, s), for views of `aspect`, width by height."""
    count = len(classes)
    low, high = _boxes(classes)
    part = rng.random((2, count, 2))
    low, high = -1 + part[0] * (low + 1), 1 - part[1] * (1 - high)
    cut = rng.uniform(LEAST_CUT, 1, (count, 2))
    place = rng.uniform(-1, 1, (count, 2)) * (1 - cut)
    framed = (rng.random(count) < FRAMED)[:, None]
    middle, half = np.where(framed, (low + high) / 2, place), np.where(framed, (high - low) / 2, cut)
    half = np.maximum(half, LEAST)
    wide = half[:, 0] / half[:, 1] / aspect
    half[:, 0] *= np.maximum(1, 1 / MOST_STRETCH / wide)
    half[:, 1] *= np.maximum(1, wide / MOST_STRETCH)
    half = np.minimum(half, 1)
    return np.clip(middle, half - 1, 1 - half), half


def _boxes(classes: NDArray[np.uint8]) -> tuple[Corners, Corners]:
    """First and last corners of the tree in each of `classes`; the whole picture where there is none."""
    tree = classes != BACKGROUND
    firsts, lasts = [], []
    for axis in (1, 2):
        seen = tree.any(axis=axis)
        side, some = seen.shape[1], seen.any(axis=1)
        firsts.append(np.where(some, 2 * seen.argmax(axis=1) / side - 1, -1))
        lasts.append(np.where(some, 1 - 2 * seen[:, ::-1].argmax(axis=1) / side, 1))
    return np.stack(firsts, axis=1), np.stack(lasts, axis=1)
