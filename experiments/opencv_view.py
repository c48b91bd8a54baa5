"""The view by OpenCV polygons, painted from back to front: what a plain implementation costs (extra: bench)."""

from __future__ import annotations

from importlib.util import find_spec

import numpy as np

from treefit.mask import BRANCH, FOLIAGE, Mask
from treefit.plant import Plant
from treefit.plant.extent import extent_of
from treefit.view import Frame

CORNERS = 8  # of a leaf
SHIFT = 4  # bits behind the point of OpenCV's coordinates


def opencv_missing() -> bool:
    """Whether OpenCV is not installed."""
    return find_spec("cv2") is None


def opencv_mask(plant: Plant, frame: Frame) -> Mask:
    """Mask (h, w) of a plant from the front."""
    import cv2

    scale = frame.height / extent_of(plant).height
    quads, quad_depth = _branches(plant)
    leaves, leaf_depth = _leaves(plant)
    polygons = [*_pixels(quads, scale, frame), *_pixels(leaves, scale, frame)]
    labels = [BRANCH] * len(quads) + [FOLIAGE] * len(leaves)
    mask = np.zeros((frame.height, frame.width), np.uint8)
    for i in np.argsort(-np.concatenate([quad_depth, leaf_depth]), kind="stable"):
        cv2.fillConvexPoly(mask, polygons[i], labels[i], shift=SHIFT)
    return mask


def _branches(plant: Plant) -> tuple[np.ndarray, np.ndarray]:
    """Corners (v-1, 4, 2) in x, z and depth of the segments."""
    parent = plant.parent[1:]
    end, start = plant.position[1:], plant.position[parent]
    along = (end - start)[:, [0, 2]]
    side = np.stack([-along[:, 1], along[:, 0]], axis=1) / (np.linalg.norm(along, axis=1, keepdims=True) + 1e-9)
    r1 = plant.radius[1:, None]
    r0 = np.where((plant.level[1:] > plant.level[parent])[:, None], r1, plant.radius[parent][:, None])
    a, b = start[:, [0, 2]], end[:, [0, 2]]
    return np.stack([a + side * r0, b + side * r1, b - side * r1, a - side * r0], axis=1), (start + end)[:, 1] / 2


def _leaves(plant: Plant) -> tuple[np.ndarray, np.ndarray]:
    """Corners (k, CORNERS, 2) in x, z and depth of the leaves."""
    angle = 2 * np.pi * np.arange(CORNERS) / CORNERS
    long = plant.leaf_axis * plant.leaf_size[:, :1] / 2
    wide = np.cross(plant.leaf_normal, plant.leaf_axis) * plant.leaf_size[:, 1:] / 2
    middle = plant.leaf_position + long
    corners = middle[:, None] + np.cos(angle)[:, None] * long[:, None] + np.sin(angle)[:, None] * wide[:, None]
    return corners[:, :, [0, 2]], middle[:, 1]


def _pixels(corners: np.ndarray, scale: float, frame: Frame) -> np.ndarray:
    pixels = np.stack([frame.width / 2 + corners[..., 0] * scale, frame.height - corners[..., 1] * scale], axis=-1)
    rounded: np.ndarray = np.round((pixels - 0.5) * 2**SHIFT).astype(np.int32, order="C")
    return rounded
