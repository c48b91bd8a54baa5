"""The slow and obvious view: every pixel centre against every primitive, the nearest one wins."""

from __future__ import annotations

import numpy as np

from treefit.mask import BRANCH, FOLIAGE, Mask
from treefit.plant import Plant
from treefit.plant.extent import extent_of
from treefit.view import Frame


def zbuffer_mask(plant: Plant, frame: Frame) -> Mask:
    """Mask (h, w) of a plant from the front; no rule of slabs, bits or spans in common with the fast one."""
    scale = frame.height / extent_of(plant).height
    columns, rows = np.meshgrid(np.arange(frame.width) + 0.5, np.arange(frame.height) + 0.5)
    depth, mask = np.full(columns.shape, np.inf), np.zeros(columns.shape, np.uint8)
    to_pixel = np.array([scale, -scale])
    place = plant.position[:, [0, 2]] * to_pixel + [frame.width / 2, frame.height]
    for i in range(1, plant.n_vertices):
        p = plant.parent[i]
        r1 = plant.radius[i] * scale
        r0 = r1 if plant.level[i] > plant.level[p] else plant.radius[p] * scale
        box = _box(np.array([place[p] - r0, place[p] + r0, place[i] - r1, place[i] + r1]), frame)
        x, y = columns[box], rows[box]
        d = place[i] - place[p]
        long = np.hypot(*d) + 1e-9
        t = ((x - place[p, 0]) * d[0] + (y - place[p, 1]) * d[1]) / long**2
        away = np.abs((x - place[p, 0]) * d[1] - (y - place[p, 1]) * d[0]) / long
        hit = (t >= 0) & (t <= 1) & (away <= r0 + (r1 - r0) * t)
        if r1 > 0.75:
            hit |= (x - place[i, 0]) ** 2 + (y - place[i, 1]) ** 2 <= r1**2
        _put(depth, mask, box, hit, (plant.position[i, 1] + plant.position[p, 1]) / 2, BRANCH)
    for i in range(plant.n_leaves):
        long = plant.leaf_axis[i] * plant.leaf_size[i, 0] / 2
        wide = np.cross(plant.leaf_normal[i], plant.leaf_axis[i]) * plant.leaf_size[i, 1] / 2
        middle = plant.leaf_position[i] + long
        axes = np.stack([long[[0, 2]], wide[[0, 2]]], axis=1) * to_pixel[:, None]
        at = middle[[0, 2]] * to_pixel + [frame.width / 2, frame.height]
        reach = np.sqrt((axes**2).sum(axis=1))
        box = _box(np.array([at - reach, at + reach]), frame)
        if abs(np.linalg.det(axes)) < 1e-9:
            continue
        inside = np.einsum("ij,jhw->ihw", np.linalg.inv(axes), np.stack([columns[box] - at[0], rows[box] - at[1]]))
        _put(depth, mask, box, (inside**2).sum(axis=0) <= 1, middle[1], FOLIAGE)
    return mask


def _box(points: np.ndarray, frame: Frame) -> tuple[slice, slice]:
    low, high = np.floor(points.min(axis=0)).astype(int), np.ceil(points.max(axis=0)).astype(int) + 1
    return slice(max(low[1], 0), max(high[1], 0)), slice(max(low[0], 0), max(high[0], 0))


def _put(depth: np.ndarray, mask: Mask, box: tuple[slice, slice], hit: np.ndarray, at: float, label: int) -> None:
    nearer = hit & (at < depth[box])
    depth[box][nearer] = at
    mask[box][nearer] = label
