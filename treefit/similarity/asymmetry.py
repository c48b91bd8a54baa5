"""Asymmetry: to which side of the trunk the tree hangs, band by band."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.similarity.rows import AREA, LEFT, MOMENT, RIGHT, rows
from treefit.view.frame import BitMask


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Asymmetry:
    """1 - sum A min(|m1 - m2| / h, 1) / sum A over `bands` of height.

    m is the mean place of a band's tree pixels from the trunk base, h half of the larger mean width of its rows, A the
    pixels of the target's band.
    """

    bands: int = Field(default=8, ge=1, le=64)

    def describe(self, bits: BitMask) -> NDArray[np.float32]:
        """Table (bands, 3) in plant heights: mean place, half of the mean width, area."""
        table = np.empty((self.bands, 3), np.float32)
        measure(rows(bits), bits.branch.shape[1] * 32, table)
        return table

    def compare(self, target: NDArray[np.float32], plant: NDArray[np.float32]) -> float:
        """Agreement in [0, 1], 1 for the same table."""
        return float(agreement(target, plant))


@njit(cache=True, nogil=True, error_model="numpy")
def measure(fields, middle, table):
    """Fill the table of the bands from the fields of the rows."""
    height, bands = fields.shape[1], len(table)
    for band in range(bands):
        area = moment = width = used = 0
        for row in range(band * height // bands, (band + 1) * height // bands):
            if fields[AREA, row] > 0:
                used += 1
                area += fields[AREA, row]
                moment += fields[MOMENT, row]
                width += fields[RIGHT, row] - fields[LEFT, row]
        table[band, 2] = area / (height * height)
        table[band, 0] = (moment / area + 0.5 - middle) / height if area > 0 else 0.0
        table[band, 1] = 0.5 * width / (used * height) if used > 0 else 0.0


@njit(cache=True, nogil=True, error_model="numpy")
def agreement(target, plant):
    """1 - mean distance of the bands' middles in half widths, weighted by the target's area."""
    loss = whole = 0.0
    for band in range(len(target)):
        area = target[band, 2]
        half = max(target[band, 1], plant[band, 1])
        if area == 0:
            continue
        whole += area
        if plant[band, 2] == 0:
            loss += area
        else:
            loss += area * min(abs(target[band, 0] - plant[band, 0]) / half, 1.0)
    return 1.0 - loss / whole if whole > 0 else 1.0
