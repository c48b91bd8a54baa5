"""Rows: a silhouette row by row, and how it fills its borders, how often it is broken and how rough its borders are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.mask import Mask

STEP = 1 / 120
"""Share of the height over which the roughness of the borders is measured."""

Counts = NDArray[np.int64]  # (h,)


@dataclass(frozen=True, eq=False)
class Rows:
    """The h rows of a silhouette, from the top, in pixels; all are 0 in an empty row.

    `left`, `right` (h,) are the borders of the content, right exclusive; `pixels` (h,) counts its pixels and `runs`
    (h,) its unbroken runs. `height` is that of the plant, h unless the rows are a band of it.
    """

    left: Counts
    right: Counts
    pixels: Counts
    runs: Counts
    height: int

    @property
    def widths(self) -> Counts:
        """Pixels (h,) from border to border: the rows of the hull."""
        return self.right - self.left

    @property
    def fill(self) -> float:
        """Share of the hull that the silhouette fills, in [0, 1]; 0 when there is nothing."""
        hull = int(self.widths.sum())
        return float(self.pixels.sum() / hull) if hull else 0.0

    @property
    def mean_runs(self) -> float:
        """Mean count of runs in the rows that are not empty; 0 when all are."""
        counted = self.runs[self.runs > 0]
        return float(counted.mean()) if len(counted) else 0.0

    @property
    def roughness(self) -> float:
        """Mean step of the left and right borders between rows that are STEP of the height apart, in % of the height.

        Empty rows are skipped. The distance is fixed because steps from row to row would shrink with the pixels.
        """
        some, apart = self.runs > 0, self._rows_apart
        borders = np.stack([self.left[some], self.right[some]])
        steps = np.abs(borders[:, apart:] - borders[:, :-apart])
        return float(100 * steps.mean() / self.height) if steps.size else 0.0

    @property
    def smallest_roughness(self) -> float:
        """Roughness that is left when one border makes a single step of a pixel, in % of the height."""
        return 50.0 / (max(int((self.runs > 0).sum()) - self._rows_apart, 1) * self.height)

    @property
    def _rows_apart(self) -> int:
        return max(round(self.height * STEP), 1)

    def band(self, first: int, end: int) -> Rows:
        """Rows `first` to `end` (exclusive)."""
        cut = slice(first, end)
        return Rows(self.left[cut], self.right[cut], self.pixels[cut], self.runs[cut], self.height)


def rows_of(mask: Mask) -> Rows:
    """Rows of the silhouette (branch or foliage) in a mask (h, w)."""
    tree = mask > 0
    some = tree.any(axis=1)
    left = np.where(some, tree.argmax(axis=1), 0)
    right = np.where(some, tree.shape[1] - tree[:, ::-1].argmax(axis=1), 0)
    runs = tree[:, 0] + (tree[:, 1:] & ~tree[:, :-1]).sum(axis=1)
    return Rows(left, right, tree.sum(axis=1), runs, len(tree))


def ratio(plant: float, target: float, smallest: float = 0.0) -> float:
    """Plant by target, 1 when they are equal; a target under `smallest`, which must not be 0 then, counts as that."""
    return 1.0 if plant == target else plant / max(target, smallest)
