"""Texture: gaps, runs and rough edges by bands of height; where they are does not matter, how many there are does."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.similarity.bits import INNER
from treefit.similarity.rows import AREA, LEFT, RIGHT, RUNS, STARTS, rows, step
from treefit.view.frame import BitMask

FILL, ACROSS, DOWN, ROUGH, HULL = range(5)
FLOOR = np.float32(0.006)  # of the height: rougher than this edges begin to count; a pixel at 128 rows is 0.008


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Texture:
    """Mean over `bands`, weighted by the target's row-filled area H, of sums of min/max of four numbers of a band.

    `fill`: gaps, 1.05 - A / H with A the area; `across`: runs a row; `down`: vertical runs by the width of the band;
    `rough`: mean step of the left and right border, in heights. Each counts with its weight by the sum of the
    weights. Spikes have the runs of clumps in one direction only, so both are asked for. Runs and borders are looked
    at in steps of 1/128 of the height, so that the numbers do not depend on the resolution.
    """

    bands: int = Field(default=10, ge=1, le=64)
    fill: float = Field(default=0.3, ge=0)
    across: float = Field(default=0.25, ge=0)
    down: float = Field(default=0.2, ge=0)
    rough: float = Field(default=0.25, ge=0)

    def describe(self, bits: BitMask) -> NDArray[np.float32]:
        """Table (bands, 5): share of gaps, runs a row, vertical runs by width, step of the borders, row-filled area."""
        table = np.empty((self.bands, 5), np.float32)
        measure(rows(bits), step(bits.branch.shape[0]), table)
        return table

    def compare(self, target: NDArray[np.float32], plant: NDArray[np.float32]) -> float:
        """Agreement in [0, 1], 1 for the same table."""
        return float(agreement(target, plant, self.fill, self.across, self.down, self.rough))


@njit(cache=True, nogil=True)
def measure(fields, step, table):
    """Fill the table of the bands from the fields of the rows."""
    height, bands = fields.shape[1], len(table)
    for band in range(bands):
        area = hull = runs = starts = moved = used = pairs = 0
        for row in range(band * height // bands, (band + 1) * height // bands):
            width = fields[RIGHT, row] - fields[LEFT, row]
            if width == 0:
                continue
            used += 1
            area += fields[AREA, row]
            hull += width
            runs += fields[RUNS, row]
            starts += fields[STARTS, row]
            if row >= step and fields[AREA, row - step] > 0:
                pairs += 1
                moved += abs(fields[LEFT, row] - fields[LEFT, row - step])
                moved += abs(fields[RIGHT, row] - fields[RIGHT, row - step])
        table[band, HULL] = np.float32(hull) / np.float32(height * height)
        if hull == 0:
            table[band, FILL] = table[band, ACROSS] = table[band, DOWN] = table[band, ROUGH] = np.float32(0.0)
            continue
        table[band, FILL] = np.float32(1.05) - np.float32(area) / np.float32(hull)
        table[band, ACROSS] = np.float32(runs) / np.float32(used * step)
        table[band, DOWN] = np.float32(starts * used) / np.float32(hull * step) + np.float32(0.2)
        table[band, ROUGH] = FLOOR + np.float32(moved) / np.float32(max(2 * pairs, 1) * height)


@njit(cache=True, nogil=True)
def agreement(target, plant, fill, across, down, rough):
    """1 - weighted mean of what min/max of the numbers of two tables lack to 1."""
    loss = weights = 0.0
    whole = fill + across + down + rough
    for band in range(len(target)):
        weight = target[band, HULL]
        if weight == 0:
            continue
        weights += weight
        if plant[band, HULL] == 0:
            loss += weight * whole
            continue
        loss += weight * (
            fill * _lack(target[band, FILL], plant[band, FILL])
            + across * _lack(target[band, ACROSS], plant[band, ACROSS])
            + down * _lack(target[band, DOWN], plant[band, DOWN])
            + rough * _lack(target[band, ROUGH], plant[band, ROUGH])
        )
    return 1.0 - loss / (weights * whole) if weights * whole > 0 else 1.0


@njit(**INNER)
def _lack(u, v):
    """1 - smaller by larger of two numbers over 0."""
    return 0.0 if u == v else 1.0 - min(u, v) / max(u, v)
