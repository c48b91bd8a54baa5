"""Layout of a photograph: where its horizon and its tree are expected, from the shape of the sky alone."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from treefit.image.picture import Region

HORIZON_RANGE = (0.45, 0.85)
LOWEST_GROUND = 0.95
LIKELY = 1.2
SIDE_LOSS, GROUND_LOSS, CORNER_LOSS = 2.0, 3.0, 2.0
SKY_LOGIT = -6.0
STEM_MARGIN = 0.2


@dataclass(frozen=True)
class Layout:
    """Row of the horizon and column of the tree, as shares of height and width."""

    horizon: float
    centre: float


def find_layout(sky: Region) -> Layout:
    """Layout whose horizon is where the sky ends beside the tree and whose centre is the mass standing before it."""
    height, width = sky.shape
    open_sky = ndimage.binary_opening(sky, iterations=2)
    depth = np.where(open_sky.any(axis=0), height - 1 - open_sky[::-1].argmax(axis=0), 0)
    low = np.percentile(depth[depth > 0], 95) / height if (depth > 0).any() else 0.6
    horizon = float(np.clip(low, *HORIZON_RANGE))
    columns = (np.arange(width) + 0.5) / width
    standing = (~sky[: int(horizon * height)]).sum(axis=0) * np.exp(-(((columns - 0.5) / 0.2) ** 2))
    weights = standing.astype(float) ** 2
    centre = float((weights * columns).sum() / weights.sum()) if weights.any() else 0.5
    return Layout(horizon, centre)


def lowered(layout: Layout, stem: Region) -> Layout:
    """`layout` with the horizon no higher than where the stem leaves the crown: the crown reaches down to there."""
    rows = np.flatnonzero(stem.any(axis=1))
    if len(rows) == 0:
        return layout
    top = float(rows[0]) / len(stem) - STEM_MARGIN
    return replace(layout, horizon=float(np.clip(max(top, layout.horizon), *HORIZON_RANGE)))


def expectation(layout: Layout, sky: Region, side_loss: float = SIDE_LOSS) -> NDArray[np.float64]:
    """(h, w) log odds that a pixel is tree before its colour is seen: less at the sides and below the horizon."""
    height, width = sky.shape
    rows = ((np.arange(height) + 0.5) / height)[:, None]
    aside = np.abs((np.arange(width) + 0.5) / width - layout.centre)[None, :]
    below = np.clip((rows - layout.horizon) / (LOWEST_GROUND - layout.horizon), 0, 1)
    side = np.maximum(aside - 0.25, 0) / 0.25
    corner = below * np.maximum(aside - 0.1, 0) / 0.4
    odds = LIKELY - side_loss * side - GROUND_LOSS * below - CORNER_LOSS * corner
    return np.where(sky, SKY_LOGIT, odds)
