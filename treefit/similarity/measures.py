"""Independent measures of how well two masks agree, reported whatever was optimised."""

from __future__ import annotations

import numpy as np

from treefit.mask import Mask


def silhouette_iou(target: Mask, plant: Mask) -> float:
    """Intersection by union of the trees (branch or foliage) in two masks (h, w)."""
    return _iou(target > 0, plant > 0)


def class_iou(target: Mask, plant: Mask) -> float:
    """Mean over background, branch and foliage of their intersection by union; classes in neither do not count."""
    classes = [label for label in range(3) if (target == label).any() or (plant == label).any()]
    return float(np.mean([_iou(target == label, plant == label) for label in classes]))


def _iou(
    one: np.ndarray[tuple[int, ...], np.dtype[np.bool_]], two: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]
) -> float:
    union = int((one | two).sum())
    return float((one & two).sum() / union) if union else 1.0
