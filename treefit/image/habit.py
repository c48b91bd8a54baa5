"""Habit: what the outline of a tree in a mask tells of its kind; a hint for leaves, never for the score."""

from __future__ import annotations

import numpy as np

from treefit.mask import FOLIAGE, Mask

_BANDS = 20  # of the crown, from the top
_LOWEST = 2  # bands at the bottom that are left out: drooping branches and the ground fray them
_NARROW = 0.27  # mean width of the upper quarter, as share of the widest band
_STEADY = 0.85  # correlation of width and depth under the top
_LEAST = 2 * _BANDS  # rows of foliage under which nothing is told


def is_cone(mask: Mask) -> bool:
    """Whether the crown in `mask` (h, w) widens steadily from a narrow top, as those of most conifers do.

    On 18 pictures of trees it found four of five such conifers and took no broadleaf for one; a columnar
    thuja is none.
    """
    foliage = mask == FOLIAGE
    rows = np.flatnonzero(foliage.any(axis=1))
    if len(rows) < _LEAST:
        return False
    widths = foliage[rows[0] : rows[-1] + 1].sum(axis=1).astype(float)
    bands = np.array([part.mean() for part in np.array_split(widths, _BANDS)])
    shown = bands[: _BANDS - _LOWEST]
    if shown.std() == 0:
        return False
    steady = float(np.corrcoef(shown, np.arange(len(shown)))[0, 1])
    return bool(bands[: _BANDS // 4].mean() <= _NARROW * bands.max() and steady >= _STEADY)
