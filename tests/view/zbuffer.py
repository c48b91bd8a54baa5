"""The yardstick of the reference view: every pixel centre against every shape in plain numpy, the nearest one wins.

Slow as can be and without any shortcut: a leaf is a fan of triangles whose barycentric coordinates give the depth.
"""

from __future__ import annotations

import numpy as np

from treefit.mask import BRANCH, FOLIAGE, Mask
from treefit.plant import Plant
from treefit.plant.extent import extent_of
from treefit.view import Frame

CORNERS = 24
ANGLES = 2 * np.pi * np.arange(CORNERS) / CORNERS
CIRCLE = np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1) * np.sqrt(2 * np.pi / CORNERS / np.sin(2 * np.pi / CORNERS))
THICK = 0.75  # radius in pixels over which joints are round


def textbook_mask(plant: Plant, frame: Frame) -> Mask:
    """Mask (h, w) of a plant from the front."""
    size = extent_of(plant).height / frame.height  # m a pixel
    x, z = np.meshgrid(np.arange(frame.width) + 0.5 - frame.width / 2, frame.height - np.arange(frame.height) - 0.5)
    centres = np.stack([x, z], axis=-1) * size
    depth, mask = np.full(x.shape, np.inf), np.zeros(x.shape, np.uint8)
    for i in range(1, plant.n_vertices):
        _put(depth, mask, _stem(plant, i, centres), BRANCH)
        if plant.radius[i] > THICK * size:
            aside = np.linalg.norm(centres - plant.position[i, [0, 2]], axis=-1)
            _put(depth, mask, plant.position[i, 1] - _bulge(plant.radius[i], aside), BRANCH)
    for i in range(plant.n_leaves):
        corners = _leaf(plant, i)
        for b in range(1, CORNERS - 1):
            _put(depth, mask, _triangle(corners[[0, b, b + 1]], centres), FOLIAGE)
    return mask


def _put(depth: np.ndarray, mask: Mask, away: np.ndarray, label: int) -> None:
    """Put a shape that is `away` (h, w) m, infinite where it is not."""
    nearer = away < depth
    depth[nearer], mask[nearer] = away[nearer], label


def _stem(plant: Plant, i: int, centres: np.ndarray) -> np.ndarray:
    p = plant.parent[i]
    a, b = plant.position[p].astype(float), plant.position[i].astype(float)
    r1 = float(plant.radius[i])
    r0 = r1 if plant.level[i] > plant.level[p] else float(plant.radius[p])
    along, length = (b - a)[[0, 2]], np.linalg.norm((b - a)[[0, 2]])
    if length < 1e-9:
        return np.full(centres.shape[:2], np.inf)
    share = (centres - a[[0, 2]]) @ along / length**2
    aside = (centres - a[[0, 2]]) @ (along[[1, 0]] * [1, -1]) / length
    away = a[1] + (b - a)[1] * share - _bulge(r0 + (r1 - r0) * share, aside)
    return np.where((share >= 0) & (share <= 1), away, np.inf)


def _bulge(radius: np.ndarray | float, aside: np.ndarray) -> np.ndarray:
    """How much nearer the round front is than the middle; minus infinite beside it."""
    inside = np.abs(aside) <= radius
    return np.where(inside, np.sqrt(np.where(inside, np.square(radius) - np.square(aside), 0)), -np.inf)


def _leaf(plant: Plant, i: int) -> np.ndarray:
    """Corners (CORNERS, 3) of a leaf."""
    long = plant.leaf_axis[i].astype(float) * plant.leaf_size[i, 0] / 2
    wide = np.cross(plant.leaf_normal[i], plant.leaf_axis[i]).astype(float) * plant.leaf_size[i, 1] / 2
    return plant.leaf_position[i] + long + CIRCLE @ np.array([long, wide])


def _triangle(corners: np.ndarray, centres: np.ndarray) -> np.ndarray:
    a, b, c = corners[:, [0, 2]]
    edges = np.stack([b - a, c - a], axis=1)
    if abs(np.linalg.det(edges)) < 1e-15:
        return np.full(centres.shape[:2], np.inf)
    two = (centres - a) @ np.linalg.inv(edges).T
    share = np.concatenate([1 - two.sum(axis=-1, keepdims=True), two], axis=-1)
    return np.where((share >= 0).all(axis=-1), share @ corners[:, 1], np.inf)
