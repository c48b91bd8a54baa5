"""Branch or foliage inside a tree that the user has shown: by strokes, else by the extractor, else by geometry."""

from __future__ import annotations

import numpy as np
from skimage.color import rgb2lab

from treefit.image.help_odds import Said, spread
from treefit.image.picture import Picture, Region, shrink
from treefit.image.resize import resize_mask, resize_strokes
from treefit.image.trunk import trunk_column
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, Mask

SIZE = 384
ALL_BRANCH = 0.95
KNOWN_CLASS = 2.0
"""Log odds of the class before strokes are seen."""


def classify(picture: Picture, tree: Region, said: Said) -> Mask:
    """Mask of `tree`; a tree that is all branch for the extractor is so where the extractor did not see it."""
    small = shrink(picture, SIZE)
    first, inside = (resize_mask(mask, small.shape) for mask in (said.first, tree.astype(np.uint8)))
    wood = _wood(first, inside.astype(bool))
    if said.strokes is not None:
        strokes = resize_strokes(said.strokes, small.shape)
        if (strokes == BRANCH).any():
            known = np.where(wood, KNOWN_CLASS, -KNOWN_CLASS)
            wood = known + spread(rgb2lab(small.rgb), strokes == BRANCH, strokes == FOLIAGE) > 0
    mask = np.where(tree, FOLIAGE, BACKGROUND).astype(np.uint8)
    mask[tree & resize_mask(wood.astype(np.uint8), tree.shape).astype(bool)] = BRANCH
    if said.strokes is not None:
        painted = np.isin(said.strokes, (BRANCH, FOLIAGE))
        mask[painted] = said.strokes[painted]
    return mask


def _wood(first: Mask, tree: Region) -> Region:
    known = tree & (first != BACKGROUND)
    if known.any() and (first[known] == BRANCH).mean() > ALL_BRANCH:
        return tree
    return np.asarray(tree & ((first == BRANCH) | (trunk_column(tree) & (first == BACKGROUND))))
