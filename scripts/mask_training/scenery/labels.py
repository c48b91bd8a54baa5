"""Labels: the classes a person would give the pixels: a closed crown, wood only where it is seen as a branch."""

from __future__ import annotations

import numpy as np
from numba import njit
from scipy.ndimage import gaussian_filter, label

from scripts.mask_training.scenery.arrays import Bools, Classes, Field
from scripts.mask_training.scenery.kernels import KERNEL
from scripts.mask_training.scenery.render import Layer
from treefit.mask import BRANCH, FOLIAGE

OVER_SKY, OVER_LAND = 0.006, 0.018
"""Radius of gaps that are closed, in sizes of the picture: gaps to the sky are seen, those to other plants are not."""
SPECK = 0.02
"""Side of the smallest branch that is told from the crown around it, in sizes of the picture."""


def person_labels(layer: Layer, land: Field, bare: bool) -> Classes:
    """Classes (h, w) of the tree; `land` is the share of each pixel where something else than sky is behind it."""
    size = len(land)
    cover = layer.cover
    if bare:
        return np.where(_soft(cover, 0.003) > 0.3, BRANCH, 0).astype(np.uint8)
    tree = _outline(cover > 0.4, land)
    green = layer.leaf + layer.twig
    wood = _soft(layer.wood, 0.004)
    branch = (wood > _soft(green, 0.004)) & (wood > 0.25) & tree
    far = _soft(layer.leaf, 0.02) < 0.06
    branch |= far & (layer.wood + layer.twig > 0.4) & tree
    branch = large(branch, (SPECK * size) ** 2)
    return np.where(branch, BRANCH, np.where(tree, FOLIAGE, 0)).astype(np.uint8)


def _outline(solid: Bools, land: Field) -> Bools:
    """`solid` pixels with small gaps closed, without loose leaves."""
    size = len(land)
    tree = np.where(land > 0.5, closed(solid, OVER_LAND * size), closed(solid, OVER_SKY * size))
    return large(tree, (0.02 * size) ** 2)


def _soft(share: Field, sigma: float) -> Field:
    """`share` blurred by `sigma` sizes of the picture."""
    blurred: Field = gaussian_filter(share, sigma * len(share), truncate=2.0)
    return blurred


def closed(mask: Bools, radius: float) -> Bools:
    """`mask` with gaps narrower than 2 `radius` closed."""
    edge = int(np.ceil(radius)) + 1
    wide = np.pad(mask, edge)
    grown = _grown(wide, radius)
    result: Bools = ~_grown(~grown, radius)[edge:-edge, edge:-edge]
    # at the border of the picture nothing is known of what is outside
    return result | mask


def large(mask: Bools, area: float) -> Bools:
    """`mask` without parts of fewer than `area` pixels."""
    parts, count = label(mask, np.ones((3, 3)))
    if count < 2:
        return mask
    keep = np.bincount(parts.ravel()) >= area
    keep[0] = False
    kept: Bools = keep[parts]
    return kept


@njit(**KERNEL)
def _grown(mask: Bools, radius: float) -> Bools:
    """`mask` and all pixels within `radius` of it."""
    height, width = mask.shape
    grown = mask.copy()
    reach = int(radius)
    for r in range(height):
        for c in range(width):
            if not mask[r, c]:
                continue
            inner = 0 < r < height - 1 and 0 < c < width - 1
            if inner and mask[r - 1, c] and mask[r + 1, c] and mask[r, c - 1] and mask[r, c + 1]:
                continue
            for v in range(max(0, r - reach), min(height - 1, r + reach) + 1):
                for u in range(max(0, c - reach), min(width - 1, c + reach) + 1):
                    if (v - r) ** 2 + (u - c) ** 2 <= radius * radius:
                        grown[v, u] = True
    return grown
