"""Belts: long flat strips of hills, hedges and horizon that hang on a tree from behind."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from treefit.image.picture import Region

THICKNESSES = (0.015, 0.07)
LEAST_WIDTH = 0.08
LEAST_FLATNESS = 2.5


def belts(tree: Region) -> Region:
    """(h, w) bool: strips of the lower half of `tree` that are thin from top to bottom and long from side to side."""
    found = np.zeros_like(tree)
    rows, columns = np.flatnonzero(tree.any(axis=1)), np.flatnonzero(tree.any(axis=0))
    if len(rows) == 0:
        return found
    height, width = int(rows[-1] - rows[0] + 1), int(columns[-1] - columns[0] + 1)
    lower = np.arange(len(tree))[:, None] >= rows[0] + height // 2
    for thickness in THICKNESSES:
        upright = np.ones((max(2, round(thickness * height)), 1), dtype=bool)
        found |= _long(tree & lower & ~ndimage.binary_opening(tree, upright), LEAST_WIDTH * width)
    return found


def _long(thin: Region, least_width: float) -> Region:
    labels, _ = ndimage.label(thin, structure=np.ones((3, 3)))
    flat = [
        index
        for index, (y, x) in enumerate(ndimage.find_objects(labels), 1)
        if x.stop - x.start > max(least_width, LEAST_FLATNESS * (y.stop - y.start))
    ]
    return np.asarray(np.isin(labels, flat))
