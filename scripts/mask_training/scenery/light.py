"""Light: where sun and sky stand to the tree, and how much of them comes through the leaves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from scripts.mask_training.scenery.arrays import Colour, Floats, Rng
from scripts.mask_training.scenery.kernels import INNER, KERNEL

CELL = 0.042
"""Edge of a voxel of the crown in heights of the tree."""
REACH = 1.05
"""Half of the voxel grid's side."""
MOST_LEAVES = 12_000
"""Of larger crowns only some leaves are counted, each for several."""


@dataclass(frozen=True)
class Light:
    """Direction to the sun as right, away from the viewer, up; strength against that of the sky; colours."""

    sun: tuple[float, float, float]
    strength: float
    sun_colour: Colour
    sky_colour: Colour
    brightness: float  # display value of the lighter leaves


def sunlight(rng: Rng, strength: float, brightness: float, low: bool = False) -> Light:
    """A sun of chance: in front of, beside or behind the tree."""
    turn = rng.uniform(0, 2 * np.pi)
    high = np.radians(rng.uniform(4, 25) if low else rng.uniform(25, 72))
    away = np.sin(turn) * np.cos(high)
    if away > 0 and rng.random() < 0.5:  # people take pictures with the sun behind them
        away = -away
    sun = (float(np.cos(turn) * np.cos(high)), float(away), float(np.sin(high)))
    warm = rng.uniform(0.15, 0.35) if low else rng.uniform(0, 0.12)
    sun_colour = (1.0 + warm * 0.5, 1.0 - 0.1 * warm, 1.0 - warm)
    blue = rng.uniform(0.0, 0.25)
    return Light(sun, strength, sun_colour, (1.0 - blue, 1.0 - 0.4 * blue, 1.0 + blue), brightness)


def depth_of_leaves(leaf: Floats, area: Floats, places: Floats, direction: Floats) -> Floats:
    """Leaf area over ground area between each of `places` (n, 3) and a light far off in `direction`.

    `leaf` (k, 3) and `area` (k,) are those of the crown, in heights and squared heights of the tree.
    """
    d = np.asarray(direction, np.float64)
    d = d / np.linalg.norm(d)
    side = np.cross(d, (0.0, 0.0, 1.0) if abs(d[2]) < 0.95 else (0.0, 1.0, 0.0))
    side /= np.linalg.norm(side)
    frame = np.stack([side, np.cross(d, side), d]).astype(np.float32)
    step = 1 + len(leaf) // MOST_LEAVES
    depth: Floats = _depth(np.ascontiguousarray(leaf[::step]), area[::step] * np.float32(step), places, frame)
    return depth


@njit(**KERNEL)
def _depth(leaf: Floats, area: Floats, places: Floats, frame: Floats) -> Floats:
    n = int(2 * REACH / CELL)
    grid = np.zeros((n, n, n), np.float32)
    part = np.float32(1 / (CELL * CELL))
    for i in range(len(leaf)):
        u, v, w = _turned(leaf, i, frame)
        grid[_cell(u, n), _cell(v, n), _cell(w, n)] += area[i] * part
    for x in range(n):
        for y in range(n):
            above = np.float32(0)
            for k in range(n):
                z = n - 1 - k
                own = grid[x, y, z]
                grid[x, y, z] = above + np.float32(0.5) * own
                above += own
    depth = np.zeros(len(places), np.float32)
    one = np.float32(1)
    for i in range(len(places)):
        # between the middles of the four columns around, so that no steps of voxels are seen
        p, q, w = _turned(places, i, frame)
        x, y, z = min(max(int(p - 0.5), 0), n - 2), min(max(int(q - 0.5), 0), n - 2), _cell(w, n)
        s = np.float32(min(max(p - 0.5 - x, 0.0), 1.0))
        t = np.float32(min(max(q - 0.5 - y, 0.0), 1.0))
        near = grid[x, y, z] * (one - t) + grid[x, y + 1, z] * t
        depth[i] = near * (one - s) + (grid[x + 1, y, z] * (one - t) + grid[x + 1, y + 1, z] * t) * s
    return depth


@njit(**INNER)
def _turned(places: Floats, i: int, frame: Floats) -> tuple[float, float, float]:
    """Place i in cells along the axes of `frame`."""
    x, y, z = places[i, 0], places[i, 1], places[i, 2] - np.float32(0.5)
    shift, cell = np.float32(REACH / CELL), np.float32(1 / CELL)
    return (
        (frame[0, 0] * x + frame[0, 1] * y + frame[0, 2] * z) * cell + shift,
        (frame[1, 0] * x + frame[1, 1] * y + frame[1, 2] * z) * cell + shift,
        (frame[2, 0] * x + frame[2, 1] * y + frame[2, 2] * z) * cell + shift,
    )


@njit(**INNER)
def _cell(place: float, n: int) -> int:
    return min(max(int(place), 0), n - 1)
