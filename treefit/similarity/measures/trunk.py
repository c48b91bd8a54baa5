"""Trunk: how high it is bare and how wide it is there, the two lengths of a tree that overlap hardly tells."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from treefit.mask import BRANCH, FOLIAGE, Mask

CROWN_SHARE = 0.25
"""A row is crown when it has this share of the foliage of a mean row with foliage."""

WINDOW = 0.02
"""Rows are judged by their mean over this share of the height, so that a hanging twig is no crown."""

FOOT = 0.04
"""Lowest share of the height in which the trunk is measured when no more of it is bare."""


def bare_trunk(mask: Mask) -> float:
    """Height of the lowest row of the crown in a mask (h, w) whose plant is h rows high, in % of h.

    From the ground up, the first row whose foliage pixels, in the mean over the rows within 1 % of h, are
    CROWN_SHARE of their mean over all rows with foliage. Without foliage the widths of the rows count instead,
    from the leftmost to the rightmost pixel. 0 when the mask is empty.
    """
    upwards = mask[::-1]
    counts = (upwards == FOLIAGE).sum(axis=1)
    if not counts.any():
        counts = _widths(upwards)
    if not counts.any():
        return 0.0
    smooth = ndimage.uniform_filter1d(counts.astype(float), 2 * round(len(mask) * WINDOW / 2) + 1, mode="nearest")
    return float(100 * np.argmax(smooth >= CROWN_SHARE * counts[counts > 0].mean()) / len(mask))


def trunk_width(mask: Mask) -> float:
    """Median count of branch pixels in the rows of the bare trunk of a mask (h, w), in % of h; 0 where no wood shows.

    The rows are those under `bare_trunk` and at least the lowest FOOT of h.
    """
    rows = max(round(bare_trunk(mask) * len(mask) / 100), round(FOOT * len(mask)), 1)
    return float(100 * np.median((mask[-rows:] == BRANCH).sum(axis=1)) / len(mask))


def _widths(mask: Mask) -> np.ndarray[tuple[int, ...], np.dtype[np.int64]]:
    tree = mask > 0
    return np.where(tree.any(axis=1), mask.shape[1] - tree.argmax(axis=1) - tree[:, ::-1].argmax(axis=1), 0)
