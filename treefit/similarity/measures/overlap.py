"""Overlap of masks: intersection by union of silhouettes and of classes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, Mask


def iou(one: NDArray[np.bool_], two: NDArray[np.bool_]) -> float:
    """Pixels in both (h, w) by pixels in either, in [0, 1]; 1 when both are empty."""
    union = int((one | two).sum())
    return float((one & two).sum() / union) if union else 1.0


def class_iou(target: Mask, plant: Mask) -> float:
    """Mean over the classes of the target, of background, branch and foliage, of their intersection by union.

    Pixels of a class that the target lacks cost the classes in whose place they are, and are no class of their own: a
    single one would cost a third.
    """
    classes = [label for label in (BACKGROUND, BRANCH, FOLIAGE) if (target == label).any()]
    return float(np.mean([iou(target == label, plant == label) for label in classes]))
