"""SketchMask: dark ink on a light ground, a line sketch or a filled silhouette."""

from __future__ import annotations

import numpy as np
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass
from scipy import ndimage
from skimage.color import rgb2gray
from skimage.morphology import disk

from treefit.image.classes import by_form
from treefit.image.extraction import Extraction
from treefit.image.picture import Picture, Region, shrink
from treefit.image.resize import resize_mask
from treefit.image.warnings import check_picture, judge

SILHOUETTE_SHARE = 0.6
LEAST_SPECK = 0.02


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class SketchMask:
    """Ink darker than `ink` (0..1 grey); gaps up to `gap` of the longer side are closed before filling."""

    ink: float = Field(default=0.78, gt=0, lt=1)
    gap: float = Field(default=0.008, ge=0, le=0.1)
    size: int = Field(default=768, ge=64, le=4096)

    def __call__(self, picture: Picture) -> Extraction:
        """Extraction of the drawn tree: filled outline, trunk by geometry."""
        check_picture(picture)
        small = shrink(picture, self.size)
        ink = rgb2gray(small.rgb) < self.ink
        filled = self._fill(ink)
        share = float(ink[filled].mean()) if filled.any() else 0.0
        silhouette = share > SILHOUETTE_SHARE
        tree = _largest(ink if silhouette else filled)
        mask = resize_mask(by_form(tree) if tree.any() else tree.astype(np.uint8), picture.shape)
        kind = "silhouette" if silhouette else "line sketch"
        why = f"dark ink fills {share:.0%} of its outline: a {kind}"
        return Extraction(mask, "sketch", 0.85 if silhouette else 0.75, why, judge(mask))

    def _fill(self, ink: Region) -> Region:
        """Ink and what it encloses once gaps are closed."""
        radius = max(1, round(self.gap * max(ink.shape)))
        wide = np.pad(ink, 2 * radius)
        closed = ndimage.binary_closing(wide, disk(radius))
        filled = ndimage.binary_fill_holes(closed)[2 * radius : -2 * radius, 2 * radius : -2 * radius]
        return np.asarray(filled)


def _largest(tree: Region) -> Region:
    """Without specks: parts smaller than a share of the largest are scribble or dust."""
    labels, count = ndimage.label(tree, structure=np.ones((3, 3)))
    if count == 0:
        return tree
    areas = np.bincount(labels.ravel())
    areas[0] = 0
    return np.asarray(np.isin(labels, np.flatnonzero(areas >= LEAST_SPECK * areas.max())))
