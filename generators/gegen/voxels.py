"""Voxels: the share of every voxel of the light's grid that a thing fills, smooth in its place and size."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from generators.gegen.field import CELLS, HIGH, WIDE
from generators.gegen.surroundings import Thing

Grid = NDArray[np.float32]  # (HIGH, WIDE, WIDE) or empty: (0, 0, 0)

_ACROSS = (np.arange(WIDE + 1) - WIDE / 2) / CELLS
_UP = np.arange(HIGH + 1) / CELLS


def shade_by_voxel(things: tuple[Thing, ...]) -> Grid:
    """Shade that every voxel adds, z y x; empty when none does."""
    grids = [thing.shade / CELLS * coverage(thing) for thing in things if thing.shade > 0]
    return np.ascontiguousarray(sum(grids), np.float32) if grids else np.zeros((0, 0, 0), np.float32)


def coverage(thing: Thing) -> NDArray[np.float64]:
    """Share of every voxel (HIGH, WIDE, WIDE) in [0, 1] that `thing` fills."""
    low, high = thing.corners[:3], thing.corners[3:]
    along_y = _share(_ACROSS, low[1], high[1])
    if thing.pixels is None:
        plane = np.outer(_share(_UP, low[2], high[2]), _share(_ACROSS, low[0], high[0]))
    else:
        plane = _area(thing.pixels, low, high)
    return plane[:, None, :] * along_y[None, :, None]


def _share(edges: NDArray[np.float64], low: float, high: float) -> NDArray[np.float64]:
    return np.diff(np.clip(edges, low, high)) * CELLS


def _area(pixels: NDArray[np.uint8], low: tuple[float, ...], high: tuple[float, ...]) -> NDArray[np.float64]:
    """Share of the voxels of a plane (HIGH, WIDE): differences of the area up to each edge, linear within a pixel."""
    rows, columns = pixels.shape
    sums = np.zeros((rows + 1, columns + 1))
    sums[1:, 1:] = pixels.cumsum(axis=0, dtype=np.float64).cumsum(axis=1)
    sums *= (high[0] - low[0]) / columns * (high[2] - low[2]) / rows
    x = np.clip((_ACROSS - low[0]) / (high[0] - low[0]), 0, 1) * columns
    z = np.clip((_UP - low[2]) / (high[2] - low[2]), 0, 1) * rows
    by_row = np.stack([np.interp(x, np.arange(columns + 1), line) for line in sums])
    at = np.stack([np.interp(z, np.arange(rows + 1), line) for line in by_row.T], axis=1)
    return np.diff(np.diff(at, axis=0), axis=1) * CELLS**2
