"""Trunk: how high it is bare, how thick, and which way it leans."""

from __future__ import annotations

from typing import NamedTuple

from numba import njit
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.similarity.rows import AREA, WOOD, WOOD_LEFT, WOOD_RIGHT, rows
from treefit.view.frame import BitMask


class TrunkShape(NamedTuple):
    """Bare height and thickness in plant heights; lean: steps to the right a step up."""

    bare: float
    thickness: float
    lean: float


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Trunk:
    """1 - (height L(bare) + thickness L(thickness) + lean |difference of leans| / 0.5) / (sum of the three weights).

    L(x) = 1 - min/max of both x plus a `slack`, so that a pixel more or less of a short trunk is forgiven; a
    difference of the leans over 0.5 counts as 0.5.
    """

    height: float = Field(default=0.5, ge=0)
    thickness: float = Field(default=0.35, ge=0)
    lean: float = Field(default=0.15, ge=0)

    def describe(self, bits: BitMask) -> TrunkShape:
        """Shape of the trunk of a mask."""
        return TrunkShape(*measure(rows(bits)))

    def compare(self, target: TrunkShape, plant: TrunkShape) -> float:
        """Agreement in [0, 1], 1 for the same shape."""
        loss = self.height * _loss(target.bare, plant.bare, BARE_SLACK)
        loss += self.thickness * _loss(target.thickness, plant.thickness, THICKNESS_SLACK)
        loss += self.lean * min(abs(target.lean - plant.lean) / 0.5, 1.0)
        return 1.0 - loss / (self.height + self.thickness + self.lean)


BARE_SLACK, THICKNESS_SLACK = 0.03, 0.004
"""In plant heights; 0.004 is half a pixel at 128 rows."""


def _loss(u: float, v: float, slack: float) -> float:
    return 1.0 - (min(u, v) + slack) / (max(u, v) + slack)


@njit(cache=True, nogil=True, error_model="numpy")
def measure(fields):
    """Bare height, thickness and lean from the fields of the rows.

    The bare trunk ends, from the ground up, where the foliage of the next 3 % of the height is over a quarter of its
    mean over all rows with foliage. Without any, thickness and lean are those of the wood in the lowest 4 %.
    """
    height = fields.shape[1]
    window = max(2, height * 3 // 100)
    leaves = leafy = 0
    for row in range(height):
        green = fields[AREA, row] - fields[WOOD, row]
        leaves += green
        leafy += green > 0
    limit = window * leaves / (4.0 * max(leafy, 1))
    bare, seen = height if leaves == 0 else 0, 0
    for up in range(height):
        row = height - 1 - up
        seen += fields[AREA, row] - fields[WOOD, row]
        if up >= window:
            seen -= fields[AREA, row + window] - fields[WOOD, row + window]
        if leaves > 0 and seen > limit:
            bare = max(up + 1 - window, 0)
            break
    wood = used = 0
    n = moment = rise = rises = cross = 0.0
    for up in range(min(max(bare, height // 25, 1), height // 2)):
        row = height - 1 - up
        if fields[WOOD, row] == 0:
            continue
        used += 1
        wood += fields[WOOD, row]
        middle = 0.5 * (fields[WOOD_LEFT, row] + fields[WOOD_RIGHT, row])
        n, moment, rise = n + 1.0, moment + middle, rise + up
        rises, cross = rises + up * up, cross + up * middle
    if used == 0:
        return bare / height, 0.0, 0.0
    spread = rises - rise * rise / n
    lean = (cross - rise * moment / n) / spread if bare >= height // 25 and spread > 0 else 0.0
    return bare / height, wood / (used * height), lean
