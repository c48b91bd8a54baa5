"""Scenes for the tests of training: a green disc on a brown bar before a colour of chance."""

from __future__ import annotations

import numpy as np

from treefit.image.picture import Rgb
from treefit.mask import BRANCH, FOLIAGE, Mask


def disc(seed: int, index: int, size: int) -> tuple[Rgb, Mask]:
    """Picture (size, size, 3) and its classes (size, size)."""
    rng = np.random.default_rng([seed, index])
    y, x = np.mgrid[:size, :size] / size - 0.5
    at, radius = rng.uniform(-0.15, 0.15), rng.uniform(0.15, 0.3)
    classes = np.zeros((size, size), np.uint8)
    classes[(abs(x - at) < 0.06) & (y > 0)] = BRANCH
    classes[(x - at) ** 2 + y**2 < radius**2] = FOLIAGE
    colours = np.array([rng.integers(150, 256, 3), (110, 70, 40), (40, 150, 50)], np.uint8)
    return colours[classes], classes
