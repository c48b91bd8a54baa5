"""Agreement: how well a plant's mask agrees with the target's, in a dozen numbers; nothing is weighed into one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple, dataclass, fields

import numpy as np

from treefit.mask import BRANCH, Mask
from treefit.similarity.measures.contour import contour_distance
from treefit.similarity.measures.overlap import class_iou, iou
from treefit.similarity.measures.rows import Rows, ratio, rows_of
from treefit.similarity.measures.texture import texture
from treefit.similarity.measures.trunk import bare_trunk, trunk_width


@dataclass(frozen=True)
class Agreement:
    """Two masks compared; `%` are percent of the plant's height, ratios and errors are plant against target.

    `silhouette_iou`, `hull_iou`, `class_iou`, `branch_iou` and `texture` are in [0, 1], 1 when alike; the ratios are 1,
    the distance and the errors 0 when alike. `hull` is the silhouette with its rows filled from border to border.
    """

    silhouette_iou: float
    hull_iou: float
    class_iou: float
    branch_iou: float
    contour_distance: float  # %, mean distance from either contour to the other
    texture: float
    fill_ratio: float  # of the share of the hull that the silhouette fills
    runs_ratio: float  # of the mean count of runs of pixels in a row
    roughness_ratio: float  # of the mean step of the borders over a 120th of the height
    bare_trunk_error: float  # %, plant - target
    trunk_width_error: float  # %, plant - target


def agreement(target: Mask, plant: Mask) -> Agreement:
    """Compare two masks (h, w) of one frame: trunk base in the middle column, plants h rows high.

    ValueError when their shapes differ or the target is empty.
    """
    if target.shape != plant.shape or not target.any():
        raise ValueError(
            f"agreement: needs two masks of one shape and a tree in the target, got {target.shape} and {plant.shape}"
        )
    wanted, found = rows_of(target), rows_of(plant)
    return Agreement(
        silhouette_iou=iou(target > 0, plant > 0),
        hull_iou=_hull_iou(wanted, found),
        class_iou=class_iou(target, plant),
        branch_iou=iou(target == BRANCH, plant == BRANCH),
        contour_distance=contour_distance(target > 0, plant > 0),
        texture=texture(wanted, found),
        fill_ratio=ratio(found.fill, wanted.fill),
        runs_ratio=ratio(found.mean_runs, wanted.mean_runs),
        roughness_ratio=ratio(found.roughness, wanted.roughness, smallest=wanted.smallest_roughness),
        bare_trunk_error=bare_trunk(plant) - bare_trunk(target),
        trunk_width_error=trunk_width(plant) - trunk_width(target),
    )


def mean_agreement(found: Sequence[Agreement]) -> Agreement | None:
    """Mean of every measure over several plants, None when there are none; errors keep their sign."""
    if not found:
        return None
    means = np.mean([astuple(one) for one in found], axis=0)
    return Agreement(**{field.name: float(mean) for field, mean in zip(fields(Agreement), means, strict=True)})


def _hull_iou(target: Rows, plant: Rows) -> float:
    """IoU of the hulls; a row of a hull is one interval, so lengths are enough."""
    left, right = np.maximum(target.left, plant.left), np.minimum(target.right, plant.right)
    shared = int(np.maximum(right - left, 0).sum())
    union = int(target.widths.sum() + plant.widths.sum()) - shared
    return shared / union
