"""Soft cut of a photograph: colour models and smoothness refine a first expectation of the tree in turn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse.linalg import cg

from treefit.image.picture import Region
from treefit.image.sky import Lab, steepness

ROUNDS = 4
PULL = 0.15
CONTRAST, LEAST_LINK = 0.01, 0.03
BINS = (10, 14, 14, 3)
BIN_BLUR = (0.8, 0.8, 0.8, 0.5)
BAND_BLUR, BAND_LEAST = 0.7, 0.002
TEXTURES = (3.0, 8.0)
RARE = 2e-5
COLOUR_LIMIT = 3.0
SKY_WEIGHT = 0.3
SMOOTH, SMOOTH_LOSS = 2.0, 2.0


@dataclass(frozen=True, eq=False)
class Known:
    """What is known before a cut, each (h, w): pixels surely tree, surely not, and how much each teaches of colours."""

    tree: Region
    ground: Region
    of_tree: NDArray[np.float64]
    of_ground: NDArray[np.float64]


def soft_cut(
    lab: Lab, expected: NDArray[np.float64], sky: Region, known: Known | None = None, bands: int = 1
) -> NDArray[np.float64]:
    """(h, w) in [0, 1]: how surely a pixel is tree.

    Each round learns the colours and textures of tree and background from the last answer, adds their log odds to
    `expected`, and smooths the result along pixels of like colour (a random walk whose ends are that result).
    Colours are learned in so many `bands` from top to bottom: a hedge behind a tree is as green, but not as high.
    """
    ones = np.ones(sky.shape)
    known = known or Known(np.zeros_like(sky), np.zeros_like(sky), ones, ones)
    bins = _bins(lab) + int(np.prod(BINS)) * _band(sky.shape, bands)
    weights = np.where(sky, SKY_WEIGHT, 1.0)
    of_tree, of_ground = weights * known.of_tree, weights * known.of_ground
    links = _links(lab, sky)
    system = (links + PULL * sparse.identity(links.shape[0])).tocsr()
    scale = sparse.diags(1 / system.diagonal())
    expected = expected - _smoothness_loss(lab)
    tree = _settled(_sigmoid(expected), np.zeros_like(sky), known)
    for _ in range(ROUNDS):
        odds = _colour_odds(bins, (of_tree * tree).ravel(), (of_ground * (1 - tree)).ravel(), bands)
        wanted = _settled(_sigmoid(expected + odds.reshape(tree.shape)), sky, known)
        walked, _ = cg(system, PULL * wanted.ravel(), x0=tree.ravel(), rtol=1e-3, maxiter=200, M=scale)
        tree = _settled(np.clip(walked.reshape(tree.shape), 0, 1), sky, known)
    return tree


def _settled(tree: NDArray[np.float64], sky: Region, known: Known) -> NDArray[np.float64]:
    """`tree` with what is known for certain."""
    return np.where(known.tree, 1.0, np.where(sky | known.ground, 0.0, tree))


def _band(shape: tuple[int, int], bands: int) -> NDArray[np.intp]:
    """(h * w,) index of the band that each pixel is in."""
    return np.repeat(np.arange(shape[0]) * bands // shape[0], shape[1])


def _smoothness_loss(lab: Lab) -> NDArray[np.float64]:
    """(h, w) log odds taken from smooth areas: hills in haze, walls and roads have no leaves."""
    return SMOOTH_LOSS * np.asarray(ndimage.gaussian_filter(steepness(lab, 1.0), 3.0) < SMOOTH)


def _sigmoid(odds: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(1 / (1 + np.exp(-odds)))


def _bins(lab: Lab) -> NDArray[np.intp]:
    """(h * w,) index of each pixel's colour and texture among BINS."""
    low, span = np.array([0.0, -50.0, -50.0]), np.array([100.0, 100.0, 120.0])
    counts = np.array(BINS[:3])
    colour = np.clip((lab - low) / span * counts, 0, counts - 1).astype(int)
    texture = np.digitize(steepness(lab, 1.5), TEXTURES)
    return np.asarray(np.ravel_multi_index((*np.moveaxis(colour, -1, 0), texture), BINS)).ravel()


def _colour_odds(
    bins: NDArray[np.intp], tree: NDArray[np.float64], ground: NDArray[np.float64], bands: int
) -> NDArray[np.float64]:
    """(h * w,) log odds of tree against background by colour, as pixels of weights `tree` and `ground` teach it."""
    odds = np.log((_shares(bins, tree, bands) + RARE) / (_shares(bins, ground, bands) + RARE))
    return np.asarray(np.clip(odds[bins], -COLOUR_LIMIT, COLOUR_LIMIT))


def _shares(bins: NDArray[np.intp], weights: NDArray[np.float64], bands: int) -> NDArray[np.float64]:
    """(bands * bins,) share of each colour in what its band has of `weights`."""
    counts = np.bincount(bins, weights=weights, minlength=bands * int(np.prod(BINS))).reshape(bands, *BINS)
    smooth = ndimage.gaussian_filter(counts, (BAND_BLUR, *BIN_BLUR)).reshape(bands, -1)
    sums = smooth.sum(axis=1, keepdims=True)
    # a band of few pixels must not shout
    least = BAND_LEAST * sums.sum() if bands > 1 else 0.0
    return np.asarray(smooth / np.maximum(sums + least, 1e-12)).ravel()


def _links(lab: Lab, sky: Region) -> sparse.csr_matrix:
    """(h * w, h * w) graph Laplacian of neighbouring pixels, links weaker where the colour changes."""
    index = np.arange(lab.shape[0] * lab.shape[1]).reshape(lab.shape[:2])
    pairs = [(index[:, :-1], index[:, 1:]), (index[:-1], index[1:])]
    steps = [lab[:, 1:] - lab[:, :-1], lab[1:] - lab[:-1]]
    here = np.concatenate([pair[0].ravel() for pair in pairs])
    there = np.concatenate([pair[1].ravel() for pair in pairs])
    change = np.concatenate([(step**2).sum(axis=-1).ravel() for step in steps])
    strength = np.exp(-CONTRAST * change) + LEAST_LINK
    # twigs before the sky must not be pulled to it
    strength[sky.ravel()[here] != sky.ravel()[there]] = 0.0
    half = sparse.coo_matrix((strength, (here, there)), shape=(index.size, index.size))
    links = (half + half.T).tocsr()
    return sparse.diags(np.asarray(links.sum(axis=1)).ravel()) - links
