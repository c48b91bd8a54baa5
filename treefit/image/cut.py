"""Soft cut of a photograph: colour models and smoothness refine a first expectation of the tree in turn."""

from __future__ import annotations

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
TEXTURES = (3.0, 8.0)
RARE = 2e-5
COLOUR_LIMIT = 3.0
SKY_WEIGHT = 0.3
SMOOTH, SMOOTH_LOSS = 2.0, 2.0


def soft_cut(lab: Lab, expected: NDArray[np.float64], sky: Region) -> NDArray[np.float64]:
    """(h, w) in [0, 1]: how surely a pixel is tree.

    Each round learns the colours and textures of tree and background from the last answer, adds their log odds to
    `expected`, and smooths the result along pixels of like colour (a random walk whose ends are that result).
    """
    bins = _bins(lab)
    weights = np.where(sky, SKY_WEIGHT, 1.0).ravel()
    links = _links(lab, sky)
    system = (links + PULL * sparse.identity(links.shape[0])).tocsr()
    scale = sparse.diags(1 / system.diagonal())
    expected = expected - _smoothness_loss(lab)
    tree = _sigmoid(expected)
    for _ in range(ROUNDS):
        odds = _colour_odds(bins, tree.ravel(), weights).reshape(tree.shape)
        wanted = np.where(sky, 0.0, _sigmoid(expected + odds))
        walked, _ = cg(system, PULL * wanted.ravel(), x0=tree.ravel(), rtol=1e-3, maxiter=200, M=scale)
        tree = np.where(sky, 0.0, np.clip(walked.reshape(tree.shape), 0, 1))
    return tree


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
    bins: NDArray[np.intp], tree: NDArray[np.float64], weights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(h * w,) log odds of tree against background by colour, as the current answer `tree` teaches it."""
    odds = np.log((_shares(bins, weights * tree) + RARE) / (_shares(bins, weights * (1 - tree)) + RARE))
    return np.asarray(np.clip(odds[bins], -COLOUR_LIMIT, COLOUR_LIMIT))


def _shares(bins: NDArray[np.intp], weights: NDArray[np.float64]) -> NDArray[np.float64]:
    counts = np.bincount(bins, weights=weights, minlength=int(np.prod(BINS))).reshape(BINS)
    smooth = ndimage.gaussian_filter(counts, BIN_BLUR).ravel()
    return np.asarray(smooth / max(float(smooth.sum()), 1e-12))


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
