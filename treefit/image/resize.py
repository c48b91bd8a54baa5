"""Masks at another size: classes are never mixed, so the nearest pixel is taken."""

from __future__ import annotations

import numpy as np

from treefit.mask import Mask


def resize_mask(mask: Mask, shape: tuple[int, int]) -> Mask:
    """Mask of `shape` (h, w), each pixel from the nearest of `mask`."""
    if mask.shape == shape:
        return mask
    rows, columns = (_nearest(old, new) for old, new in zip(mask.shape, shape, strict=True))
    return np.ascontiguousarray(mask[np.ix_(rows, columns)])


def resize_strokes(strokes: Mask, shape: tuple[int, int]) -> Mask:
    """`strokes` at `shape` (h, w): when it is smaller a stroke is kept however thin, BACKGROUND being no stroke."""
    (height, width), resized = strokes.shape, resize_mask(strokes, shape)
    if shape[0] < height or shape[1] < width:
        rows, columns = np.nonzero(strokes)
        resized[rows * shape[0] // height, columns * shape[1] // width] = strokes[rows, columns]
    return resized


def _nearest(old: int, new: int) -> np.ndarray[tuple[int], np.dtype[np.intp]]:
    """(new,) index into `old` pixels of the pixel under each new pixel's centre."""
    return ((np.arange(new) + 0.5) * old / new).astype(np.intp)
