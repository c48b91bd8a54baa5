"""The tree at a point: an extractor that takes what is in the middle is shown the picture around the point."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy import ndimage

from treefit.image.extraction import Extraction, Extractor
from treefit.image.help import ROUGH
from treefit.image.picture import Picture, cut_out
from treefit.image.read import NoTreeError
from treefit.image.resize import resize_mask
from treefit.mask import BACKGROUND, Mask

Pixel = tuple[int, int]
"""Row and column."""

LEAST_REACH = 0.25
SIZE = 1024
GAP = 0.004
"""Parts that are closer, in lengths of the longer side, are one tree."""


def look_at(picture: Picture, point: Pixel, extractor: Extractor) -> Extraction:
    """Extraction of the whole picture or, when it leaves out `point`, of the columns around that."""
    try:
        found = extractor(picture)
    except NoTreeError:
        found = None
    if found is not None and _distance(found.mask, point) <= ROUGH * max(picture.shape):
        return found
    width = picture.shape[1]
    half = round(max(LEAST_REACH * width, min(point[1], width - point[1])))
    columns = slice(max(0, point[1] - half), min(width, point[1] + half))
    try:
        again = extractor(cut_out(picture, slice(None), columns))
    except NoTreeError:
        if found is None:
            raise
        return found
    mask = np.zeros(picture.shape, np.uint8)
    mask[:, columns] = again.mask
    nearer = found is None or _distance(mask, point) < _distance(found.mask, point)
    return replace(again, mask=mask) if nearer or found is None else found


def part_at(mask: Mask, point: Pixel) -> Mask:
    """The connected part of `mask` that is at `point` or nearest to it, the rest being background."""
    height, width = (max(1, round(side * min(1, SIZE / max(mask.shape)))) for side in mask.shape)
    tree = resize_mask(mask, (height, width)) != BACKGROUND
    if not tree.any():
        return mask
    near = ndimage.distance_transform_edt(~tree) <= GAP * max(tree.shape)
    labels, _ = ndimage.label(near)
    row, column = point[0] * height // mask.shape[0], point[1] * width // mask.shape[1]
    to_tree = ndimage.distance_transform_edt(~tree, return_distances=False, return_indices=True)
    part = labels == labels[tuple(to_tree[:, row, column])]
    return np.where(resize_mask(part.astype(np.uint8), mask.shape) > 0, mask, BACKGROUND).astype(np.uint8)


def _distance(mask: Mask, point: Pixel) -> float:
    """Pixels from `point` to the nearest of the tree."""
    rows, columns = np.nonzero(mask)
    return float(np.hypot(rows - point[0], columns - point[1]).min(initial=np.inf))
