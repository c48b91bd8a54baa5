"""Odds: what an outline, strokes and an extractor say of each pixel before its colour is compared."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from skimage.graph import MCP_Geometric

from treefit.image.cut import Known
from treefit.image.help import ROUGH
from treefit.image.picture import Region
from treefit.image.sky import Lab, steepness
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, Mask

NOT_TREE = 3
"""Value of a stroke that says: no tree here. BRANCH and FOLIAGE are the others, BACKGROUND is no stroke at all."""

TREE = (BRANCH, FOLIAGE)

INSIDE, OUTSIDE = 2.5, -3.0
EDGE, RAMP, THINNEST = 0.025, 0.06, 0.15
"""Shares of the outline's size: hands draw around a tree, so its edge is that far inside, and all sure so far off."""

FIRST = 2.0
DISTRUST, TRUST = 0.6, 0.9
"""Agreement with the outline up to which an extractor does not count at all, and from which it counts fully."""

STROKE, REACH = 4.0, 0.12
TEACHES = 20.0
FAR = 1e3
BLUR, STEP = 1.5, 0.3
"""Steps of colour are those of the picture blurred by so many pixels; one of 1 in Lab makes a way so much longer."""

Odds = NDArray[np.float64]
"""(h, w) log odds that a pixel is tree."""


@dataclass(frozen=True, eq=False)
class Said:
    """What is said of a picture, each (h, w): the extractor's mask, the inside of the outline, strokes."""

    first: Mask
    outline: Region | None = None
    strokes: Mask | None = None


def odds_of(said: Said, lab: Lab, sky: Region) -> tuple[Odds, Known]:
    """Log odds of tree, and what is known for certain, of the picture `lab`."""
    nowhere, ones = np.zeros_like(sky), np.ones(sky.shape)
    odds, trust = np.zeros(sky.shape), 1.0
    tree, ground, of_tree, of_ground = nowhere, nowhere, ones, ones
    if said.outline is not None:
        depth, size = _depth(said.outline)
        inside = _insideness(depth, size)
        odds += np.where(inside > 0, INSIDE, -OUTSIDE) * inside
        ground, of_tree = depth < -ROUGH, np.clip(inside, 0, 1)
        trust = _trust(said.first != BACKGROUND, said.outline, sky)
    odds += trust * FIRST * np.where(said.first != BACKGROUND, 1, -1)
    if said.strokes is not None:
        tree, stroked_out = np.isin(said.strokes, TREE), said.strokes == NOT_TREE
        ground = (ground & ~tree) | stroked_out
        odds += spread(lab, tree, stroked_out)
        of_tree, of_ground = of_tree + TEACHES * tree, of_ground + TEACHES * stroked_out
    return odds, Known(tree, ground, of_tree, of_ground)


def spread(lab: Lab, yes: Region, no: Region) -> Odds:
    """Log odds from strokes: highest near `yes` and lowest near `no`, by ways that keep to pixels of like colour."""
    soft = np.stack([ndimage.gaussian_filter(lab[..., channel], BLUR) for channel in range(3)], axis=-1)
    costs = (1 + STEP * steepness(soft, 1.0)) / max(yes.shape)
    to_yes, to_no = (_ways(costs, seeds) for seeds in (yes, no))
    near = np.exp(-np.minimum(to_yes, to_no) / REACH)
    return np.asarray(STROKE * near * (to_no - to_yes) / np.maximum(to_no + to_yes, 1e-9))


def _ways(costs: NDArray[np.float64], seeds: Region) -> NDArray[np.float64]:
    """(h, w) least cost of a way from `seeds`."""
    if not seeds.any():
        return np.full(costs.shape, FAR)
    ways, _ = MCP_Geometric(costs).find_costs(np.argwhere(seeds).tolist())
    return np.asarray(ways)


def _depth(outline: Region) -> tuple[NDArray[np.float64], int]:
    """(h, w) distance to the edge of `outline`, negative outside, in lengths of its longer side; that in pixels."""
    rows, columns = np.flatnonzero(outline.any(axis=1)), np.flatnonzero(outline.any(axis=0))
    size = int(max(rows[-1] - rows[0], columns[-1] - columns[0])) + 1
    within = ndimage.distance_transform_edt(outline)
    return np.asarray((within - ndimage.distance_transform_edt(~outline)) / size), size


def _insideness(depth: NDArray[np.float64], size: int) -> NDArray[np.float64]:
    """(h, w) in [-1, 1]: 1 well inside an outline, and in the middle of what is thin of it, as a trunk is."""
    window = 2 * round(RAMP * size) + 1
    thickness = np.clip(ndimage.maximum_filter(depth, window) / (EDGE + RAMP), THINNEST, 1)
    scale = np.where(depth > 0, thickness, 1.0)
    return np.asarray(np.clip((depth - EDGE * scale) / (RAMP * scale), -1, 1))


def _trust(first: Region, outline: Region, sky: Region) -> float:
    """Weight in [0, 1] of an extractor's tree by how well it fills the outline."""
    either = (first | outline) & ~sky
    agreement = (first & outline & ~sky).sum() / max(1, either.sum())
    return float(np.clip((agreement - DISTRUST) / (TRUST - DISTRUST), 0, 1))
