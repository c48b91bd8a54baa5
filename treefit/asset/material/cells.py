"""Cells: plates, ridges and flakes around scattered middles on the unit square, which repeats without a seam."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import njit

from treefit.asset.material.noise import Field
from treefit.plant.compiling import FAST


@dataclass(frozen=True, eq=False)
class Cells:
    """What each pixel (n, n) knows of its cell; lengths in cells."""

    middle: Field  # distance to the middle of the cell
    border: Field  # distance to the nearest border of the cell
    draw: Field  # a number in [0, 1) of the cell


def cells(n: int, columns: int, rows: int, seed: int, warp: tuple[Field, Field], jitter: float = 0.9) -> Cells:
    """Cells around jittered middles, `columns` by `rows` of them; `warp` moves pixels across and down, in sides."""
    draws = np.random.default_rng(seed).random((3, rows, columns), dtype=np.float32)
    middles = np.float32(0.5) + np.float32(jitter) * (draws[:2] - np.float32(0.5))
    middles[1, :, 1::2] = (middles[1, :, 1::2] + np.float32(0.5)) % 1  # as bricks, so that no line goes through
    found = np.empty((3, n, n), np.float32)
    across, down = (np.ascontiguousarray(part, np.float32) for part in warp)
    _fill(across, down, middles[0], middles[1], draws[2], found)
    return Cells(*found)


@njit(**FAST)
def _fill(across, down, middle_x, middle_y, draw, found):
    """Fill `found` (3, n, n): distance to the middle of the nearest cell, to its border, and its draw."""
    n, rows, columns = across.shape[0], draw.shape[0], draw.shape[1]
    half = np.float32(0.5)
    for i in range(n):
        for j in range(n):
            x = ((np.float32(j) + half) / np.float32(n) + across[i, j]) * np.float32(columns)
            y = ((np.float32(i) + half) / np.float32(n) + down[i, j]) * np.float32(rows)
            column, row = int(math.floor(x)), int(math.floor(y))
            x -= np.float32(column)
            y -= np.float32(row)
            least, best_x, best_y = np.float32(9.0), np.float32(0.0), np.float32(0.0)
            for r in range(-1, 2):
                for c in range(-1, 2):
                    p, q = (row + r) % rows, (column + c) % columns
                    dx, dy = middle_x[p, q] + np.float32(c) - x, middle_y[p, q] + np.float32(r) - y
                    far = dx * dx + dy * dy
                    if far < least:
                        least, best_x, best_y = far, dx, dy
                        found[2, i, j] = draw[p, q]
            border = np.float32(9.0)
            for r in range(-2, 3):
                for c in range(-2, 3):
                    p, q = (row + r) % rows, (column + c) % columns
                    dx, dy = middle_x[p, q] + np.float32(c) - x, middle_y[p, q] + np.float32(r) - y
                    ox, oy = dx - best_x, dy - best_y
                    apart = ox * ox + oy * oy
                    if apart > np.float32(1e-6):
                        border = min(border, half * (dx * dx + dy * dy - least) / math.sqrt(apart))
            found[0, i, j], found[1, i, j] = math.sqrt(least), border
