"""Refine: what a network believes, the colours of the picture and where trees stand agree on one tree."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from skimage.color import rgb2lab

from treefit.image.belief import Belief, resized
from treefit.image.cut import Known, soft_cut
from treefit.image.guided import upsample
from treefit.image.layout import expectation, find_layout
from treefit.image.one_tree import one_tree
from treefit.image.picture import Picture, Region, Rgb, shrink
from treefit.image.resize import resize_mask
from treefit.image.sky import find_sky, gaps
from treefit.image.stem import find_stem
from treefit.mask import BACKGROUND, BRANCH

SIZE = 256
"""Pixels of the longer side at which colours are learned."""

SURE_TREE = 0.95
"""Probability from which the network is right though a pixel looks like sky: blossom, snow on branches."""

LEAST, MOST = 0.15, 0.85
"""Probabilities are held within these: a network is never as sure as it says."""

SURE_BRANCH, BESIDE_BRANCH = 0.5, 0.3
"""Probability of branch from which a pixel is surely tree, and that makes the stem beside it believable."""

MIDDLE = 0.4
"""Deviation of the part that teaches what colours the tree has, in deviations of the whole tree."""

ASIDE_LOSS = 1.0
"""Log odds that a pixel loses at the side of the picture: half of what it loses when only the sky is known."""

OWN = 0.25
"""Share of the network's own answer in the last word: colours are too strict with sparse and with wide crowns."""

BANDS = 4
LIKELY = 0.5
REACH, SMOOTHNESS = 4, 3e-4
"""Pixels of the small picture by which an edge may move to one of the colours; how little counts as one."""

Likely = NDArray[np.float64]
"""(h, w) in [0, 1]: how surely a pixel is tree."""


def refine(belief: Belief, picture: Picture, fine: Rgb) -> Region:
    """(h, w) bool at the size of `fine`: the tree that `belief` sees in `picture`, cut out along its colours.

    The neighbour of a tree is a tree too, and a network that takes both is as sure of it. Its colours are another's:
    they are learned from the middle of what the network found, and count against it at its sides. A trunk is of
    another colour than its crown, and stands where others have grass: for it the network and its two edges decide.
    """
    small = shrink(picture, SIZE).rgb
    seen = resized(belief, small.shape[:2]).astype(np.float64)
    tree, branch = 1 - seen[..., BACKGROUND], seen[..., BRANCH]
    lab = rgb2lab(small)
    blue = find_sky(lab)
    sky = blue & (tree < SURE_TREE)
    layout = find_layout(blue)
    trunk = branch > SURE_BRANCH
    known = Known(trunk, np.zeros_like(sky), tree * _middle(tree), np.ones_like(tree))
    expected = expectation(layout, blue, ASIDE_LOSS)
    odds = _log_odds(tree) + np.where(expected < 0, expected * (1 - branch), expected)
    cut = soft_cut(lab, odds, sky & ~trunk, known, BANDS)
    likely = (1 - OWN) * cut + OWN * np.where(sky, 0, tree)
    stem = find_stem(lab, blue, layout) & (ndimage.maximum_filter(branch, 5) > BESIDE_BRANCH)
    return one_tree(_sharpen(likely, sky, lab, small, fine) | _enlarged(stem, fine))


def _sharpen(likely: Likely, sky: Region, lab: NDArray[np.float64], small: Rgb, fine: Rgb) -> Region:
    """(h, w) bool at the size of `fine`: where tree is `likely`, without the sky in its gaps."""
    sure = upsample(likely.astype(np.float32)[..., None], small, fine, REACH, SMOOTHNESS)[..., 0] > LIKELY
    near_sky = _enlarged(ndimage.binary_dilation(sky), fine)
    return sure & ~gaps(fine, sure & near_sky, lab[sky])


def _log_odds(tree: Likely) -> Likely:
    shares = np.clip(tree, LEAST, MOST)
    return np.log(shares / (1 - shares))


def _middle(tree: Likely) -> Likely:
    """(h, w) in [0, 1]: 1 in the middle of `tree`, falling off as a normal distribution."""
    total = max(float(tree.sum()), 1e-9)
    nearness = np.zeros(tree.shape)
    for axis in (0, 1):
        places = np.expand_dims(np.arange(tree.shape[axis], dtype=float), 1 - axis)
        offsets = places - (tree * places).sum() / total
        variance = (tree * offsets**2).sum() / total
        nearness = nearness + offsets**2 / max(float(variance), 1.0)
    return np.asarray(np.exp(-nearness / (2 * MIDDLE**2)))


def _enlarged(region: Region, fine: Rgb) -> Region:
    return resize_mask(region.astype(np.uint8), fine.shape[:2]).astype(bool)
