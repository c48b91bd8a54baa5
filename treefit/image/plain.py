"""Plain ground: pictures whose border is of nearly one colour, as drawings and studio pictures have."""

from __future__ import annotations

import numpy as np
from scipy import ndimage
from skimage.color import rgb2lab

from treefit.image.picture import Region, Rgb

SAME_COLOUR = 8.0
PLAIN_SHARE = 0.93
LEAST_SPECK = 0.01


def has_plain_border(rgb: Rgb) -> bool:
    """Whether the top and both sides are of one colour; a trunk may leave at the bottom."""
    border, colour = _border(rgb)
    return bool((np.linalg.norm(border - colour, axis=-1) < SAME_COLOUR).mean() > PLAIN_SHARE)


def differs_from_border(rgb: Rgb) -> Region:
    """(h, w) bool: pixels unlike the border's colour, without specks."""
    _, colour = _border(rgb)
    differs = np.linalg.norm(rgb2lab(rgb) - colour, axis=-1) > SAME_COLOUR
    labels, count = ndimage.label(differs, structure=np.ones((3, 3)))
    if count == 0:
        return np.asarray(differs)
    areas = np.bincount(labels.ravel())
    areas[0] = 0
    return np.asarray(np.isin(labels, np.flatnonzero(areas >= LEAST_SPECK * areas.max())))


def _border(rgb: Rgb) -> tuple[np.ndarray, np.ndarray]:
    """Lab colours (n, 3) of the top row and both side columns, and their median."""
    border = rgb2lab(np.concatenate((rgb[0], rgb[:, 0], rgb[:, -1]))[None])[0]
    return border, np.median(border, axis=0)
