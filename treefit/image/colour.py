"""ColourMask: the tree by its colours, before a plain ground or in a photograph (sec. 4 and beyond)."""

from __future__ import annotations

import numpy as np
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass
from scipy import ndimage
from skimage.color import rgb2lab

from treefit.image.belt import belts
from treefit.image.classes import by_colour, is_strokes, leaf_share
from treefit.image.cut import soft_cut
from treefit.image.extraction import Extraction
from treefit.image.layout import Layout, expectation, find_layout, lowered
from treefit.image.picture import Picture, Region, Rgb, shrink
from treefit.image.plain import differs_from_border, has_plain_border
from treefit.image.resize import resize_mask
from treefit.image.sky import find_sky
from treefit.image.stem import find_stem
from treefit.image.trunk import trunk_column
from treefit.image.warnings import check_picture, judge
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, Mask

LEAFLESS_SHARE = 0.15


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class ColourMask:
    """Works at `size` pixels of the longer side; the colours of a photograph are learned at `coarse` pixels."""

    size: int = Field(default=512, ge=64, le=2048)
    coarse: int = Field(default=256, ge=64, le=1024)

    def __call__(self, picture: Picture) -> Extraction:
        """Extraction by difference from a plain border if there is one, else by sky, horizon and learned colours."""
        check_picture(picture)
        fine = shrink(picture, self.size).rgb
        if has_plain_border(fine):
            tree = differs_from_border(fine)
            mask = by_colour(fine, tree) if tree.any() else tree.astype(np.uint8)
            confidence, why = 0.8, "the picture has a plain border, the tree is what differs from it"
        else:
            mask, layout = self._photograph(picture, fine)
            confidence, why = (
                0.5,
                f"a photograph: tree colours learned above its horizon at {layout.horizon:.0%} height",
            )
        mask = resize_mask(mask, picture.shape)
        return Extraction(mask, "colour", confidence, why, judge(mask))

    def _photograph(self, picture: Picture, fine: Rgb) -> tuple[Mask, Layout]:
        lab = rgb2lab(shrink(picture, self.coarse).rgb)
        sky = find_sky(lab)
        layout = find_layout(sky)
        stem = find_stem(lab, sky, layout)
        layout = lowered(layout, stem)
        crown = soft_cut(lab, expectation(layout, sky), sky)
        stem = _resize_region(stem, fine)
        tree = _sharpen(crown, sky, fine)
        tree = _middle_part((tree & ~belts(tree)) | stem, layout)
        return _classes(fine, tree, stem & tree), layout


def _sharpen(crown: np.ndarray, sky: Region, fine: Rgb) -> Region:
    """(h, w) bool at the size of `fine`: the sure part of `crown` without the sky that shows through it."""
    height, width = fine.shape[:2]
    factors = (height / crown.shape[0], width / crown.shape[1])
    sure = ndimage.zoom(crown, factors, order=1, grid_mode=True, mode="nearest") > 0.5
    # film grain looks like gaps at full size: only sky that the coarse picture confirms counts
    near_sky = _resize_region(ndimage.binary_dilation(sky, iterations=1), fine)
    return np.asarray(sure & ~(find_sky(rgb2lab(fine)) & near_sky))


def _resize_region(region: Region, fine: Rgb) -> Region:
    return resize_mask(region.astype(np.uint8), fine.shape[:2]).astype(bool)


def _middle_part(tree: Region, layout: Layout) -> Region:
    """The connected part with most pixels near the expected column."""
    labels, count = ndimage.label(tree, structure=np.ones((3, 3)))
    if count == 0:
        return tree
    columns = (np.arange(tree.shape[1]) + 0.5) / tree.shape[1]
    weight = np.broadcast_to(np.exp(-(((columns - layout.centre) / 0.25) ** 2)), tree.shape)
    mass = ndimage.sum_labels(weight, labels, np.arange(1, count + 1))
    return np.asarray(labels == 1 + int(np.argmax(mass)))


def _classes(rgb: Rgb, tree: Region, stem: Region) -> Mask:
    """In a photograph hue tells wood from leaves poorly: branch is the stem and the column, or all when leafless."""
    mask = np.where(tree, FOLIAGE, BACKGROUND).astype(np.uint8)
    if tree.any() and leaf_share(rgb, tree) < LEAFLESS_SHARE and is_strokes(tree):
        mask[tree] = BRANCH
        return mask
    mask[stem | trunk_column(tree)] = BRANCH
    return mask
