from __future__ import annotations

import numpy as np
import pytest

from treefit.similarity.measures import class_iou, silhouette_iou

ONE = np.array([[0, 1, 2, 2], [0, 0, 2, 0]], np.uint8)
TWO = np.array([[0, 1, 1, 2], [0, 2, 0, 0]], np.uint8)


def test_silhouette_iou_is_shared_by_joined_pixels() -> None:
    assert silhouette_iou(ONE, TWO) == pytest.approx(3 / 5)
    assert silhouette_iou(ONE, ONE) == 1


def test_class_iou_is_the_mean_over_the_classes_present() -> None:
    assert class_iou(ONE, TWO) == pytest.approx((3 / 5 + 1 / 2 + 1 / 4) / 3)
    assert class_iou(np.zeros((2, 2), np.uint8), np.zeros((2, 2), np.uint8)) == 1
