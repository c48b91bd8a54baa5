"""AlphaMask: a cut-out, where the tree is what is opaque."""

from __future__ import annotations

import numpy as np
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass
from scipy import ndimage
from skimage.color import rgb2hsv

from treefit.image.classes import by_colour
from treefit.image.extraction import Extraction
from treefit.image.picture import Picture, Region, Rgb, shrink
from treefit.image.read import PictureError
from treefit.image.resize import resize_mask
from treefit.image.warnings import check_picture, judge
from treefit.mask import BACKGROUND

SHADOW_SATURATION = 0.12
SHADOW_SHARE = 0.25
LEAST_SOLID = 0.35


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class AlphaMask:
    """Pixels of at least `threshold` opacity are the tree; a grey ground shadow under it is taken off."""

    threshold: int = Field(default=128, ge=1, le=255)
    size: int = Field(default=1024, ge=64, le=4096)

    def __call__(self, picture: Picture) -> Extraction:
        """Extraction of the opaque part."""
        check_picture(picture)
        if picture.alpha is None:
            raise PictureError("mask=alpha needs a picture with transparent parts; use mask=auto")
        small = shrink(picture, self.size)
        assert small.alpha is not None
        tree = small.alpha >= self.threshold
        tree &= ~ground_shadow(small.rgb, tree)
        mask = by_colour(small.rgb, tree) if tree.any() else tree.astype(np.uint8)
        mask = resize_mask(mask, picture.shape)
        mask[picture.alpha < self.threshold] = BACKGROUND
        return Extraction(mask, "alpha", 0.9, f"{tree.mean():.0%} of the picture is opaque", judge(mask))


def ground_shadow(rgb: Rgb, tree: Region) -> Region:
    """(h, w) bool: grey pixels at the foot that spread wider than the wood above them, as clip-art shadows do."""
    nothing = np.zeros_like(tree)
    rows = np.flatnonzero(tree.any(axis=1))
    if len(rows) == 0:
        return nothing
    hsv = rgb2hsv(rgb)
    grey = tree & (hsv[..., 1] < SHADOW_SATURATION)
    low = np.arange(len(tree))[:, None] > rows[-1] - SHADOW_SHARE * (rows[-1] - rows[0])
    labels, count = ndimage.label(grey & low)
    coloured_share = (tree & ~grey).sum() / tree.sum()
    if count == 0 or coloured_share < 0.3:
        return nothing
    boxes = ndimage.find_objects(labels)
    flat = [index for index, box in enumerate(boxes, 1) if _is_disc(labels[box] == index, tree)]
    return np.asarray(np.isin(labels, flat))


def _is_disc(part: Region, tree: Region) -> bool:
    """Whether `part`, cut to its box, is wide, flat and solid: a drawn outline is not."""
    height, width = part.shape
    columns = np.flatnonzero(tree.any(axis=0))
    wide = width > 1.6 * height and width > 0.25 * (columns[-1] - columns[0] + 1)
    return bool(wide and part.mean() > LEAST_SOLID)
