"""Light in a crown: how much sky each point sees through the leaves, and where the sun's shadow falls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.asset.pictures.zbuffer import nearest_triangles
from treefit.plant import Plant

Floats = NDArray[np.float32]

SUN = np.array([-0.38, -0.50, 0.78], dtype=np.float32)  # towards the sun: left, before the plant, high
SUN /= np.linalg.norm(SUN)
_CELLS = 24  # of the longest side of the crown
_MAP = 640  # pixels of the sun's view
_BLOCK = 16_384  # points at a time, so that they stay in the cache
_EXTINCTION = 0.35  # loss of light per leaf area over ground area; under the physical 0.5 so the inside stays readable


def sky_seen(plant: Plant, place: Floats) -> Floats:
    """Share of the sky (n,) in [0, 1] that each point of `place` (n, 3) sees through the leaves."""
    if plant.n_leaves == 0:
        return np.ones(len(place), dtype=np.float32)
    centres = plant.leaf_position + plant.leaf_axis * plant.leaf_size[:, :1] / 2
    low = centres.min(axis=0)
    cell = max(float(np.ptp(centres, axis=0).max()) / _CELLS, 1e-6)
    index = ((centres - low) / cell).astype(np.int64) + 2
    shape = index.max(axis=0) + 3
    area = np.pi / 4 * plant.leaf_size[:, 0] * plant.leaf_size[:, 1]
    flat = np.ravel_multi_index(tuple(index.T), tuple(shape))
    layer = np.bincount(flat, area, int(shape.prod())).reshape(shape) / cell**2
    openness = _openness(_blurred(layer))
    return _sample(openness, (place - low) / cell + 1.5)


def _openness(layer: NDArray[np.float64]) -> NDArray[np.float64]:
    """Light that reaches each cell from above (half) and from the left, right and front (the rest)."""
    from_above = np.flip(np.cumsum(np.flip(layer, 2), 2), 2)
    from_left, from_front = np.cumsum(layer, 0), np.cumsum(layer, 1)
    from_right = np.flip(np.cumsum(np.flip(layer, 0), 0), 0)
    ways = ((0.5, from_above), (0.15, from_left), (0.15, from_right), (0.2, from_front))
    total = np.zeros_like(layer)
    for weight, depth in ways:
        total += weight * np.exp(-_EXTINCTION * np.maximum(depth - layer / 2, 0))
    return total


def _blurred(layer: NDArray[np.float64]) -> NDArray[np.float64]:
    """Three-cell mean along every axis (the border is empty)."""
    for axis in range(3):
        layer = (np.roll(layer, 1, axis) + layer + np.roll(layer, -1, axis)) / 3
    return layer


def _sample(grid: NDArray[np.float64], at: Floats) -> Floats:
    """Trilinear values (n,) of `grid` at `at` (n, 3) in cells."""
    values = np.empty(len(at), dtype=np.float32)
    for first in range(0, len(at), _BLOCK):
        block = slice(first, first + _BLOCK)
        values[block] = _trilinear(grid, at[block])
    return values


def _trilinear(grid: NDArray[np.float64], at: Floats) -> NDArray[np.float64]:
    inside = np.clip(at, 0, np.array(grid.shape) - 1.001)
    low = inside.astype(np.int64)
    part = (inside - low).T
    ways = np.stack([1 - part, part])  # (2, 3, n): weights of the lower and the upper cell along every axis
    first = np.ravel_multi_index(tuple(low.T), grid.shape)
    cells, value = grid.ravel(), np.zeros(len(at))
    for x, y, z in np.ndindex(2, 2, 2):
        there = first + int(np.ravel_multi_index((x, y, z), grid.shape))
        value += ways[x, 0] * ways[y, 1] * ways[z, 2] * cells[there]
    return value


@dataclass(frozen=True, eq=False)
class SunMap:
    """Depth along the sun's rays of what it sees first."""

    depth: Floats  # (m, m), infinite where the ray meets nothing
    turn: Floats  # (3, 3): rows are column, row and depth directions, per metre
    shift: Floats  # (3,)

    def project(self, place: Floats) -> Floats:
        """Column, row, depth (n, 3) in the map of `place` (n, 3)."""
        return np.asarray(np.einsum("ni,ji->nj", place, self.turn) + self.shift, dtype=np.float32)


def sun_map(place: Floats, faces: NDArray[np.int32]) -> SunMap:
    """Return the sun's view of the triangles."""
    right = np.cross([0.0, 0.0, 1.0], SUN)
    right /= np.linalg.norm(right)
    turn = np.stack([right, np.cross(SUN, right), -SUN]).astype(np.float32)
    seen = np.einsum("ni,ji->nj", place, turn)  # a tenth of the time of `@` with three columns
    low, high = seen.min(axis=0), seen.max(axis=0)
    scale = (_MAP - 8) / max(float((high - low)[:2].max()), 1e-6)
    stretch = np.array([scale, scale, 1], dtype=np.float32)
    shift = np.array([4 - scale * low[0], 4 - scale * low[1], 0], dtype=np.float32)
    _, depth = nearest_triangles(seen * stretch + shift, faces, _MAP, _MAP)
    return SunMap(depth, turn * stretch[:, None], shift)
