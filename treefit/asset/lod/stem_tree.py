"""Stem tree: the stems of a plant, each with the one that carries it and with what every ring does for its shape."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.mesh.stems import Stems
from treefit.plant.corners import corners_of
from treefit.plant.rings import NO_COLLAR

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_SHIFTED = 0.5
"""Worth of a displaced area against one that is missing: not in its place it is twice wrong, but it is there."""


@dataclass(frozen=True, eq=False)
class StemTree:
    """Stems (s,) along their rings (r,); a host comes before the stems that it carries."""

    stems: Stems
    host: Ints  # (s,) stem that carries each one, -1 for those of the root
    corners: Ints  # (s,) of its rings in the whole model, where it is round
    bend: Floats  # (r,) m2, area by which the stem would look displaced without this ring; infinite at both ends

    def __len__(self) -> int:
        """Count of stems."""
        return len(self.host)

    def area(self) -> Floats:
        """Area (s,) m2 of each stem seen from its side."""
        width = np.r_[self.stems.radius[1:] + self.stems.radius[:-1], 0.0]
        return self.sum(self._steps() * width)

    def length(self) -> Floats:
        """Length (s,) m of each stem."""
        return self.sum(self._steps())

    def sum(self, value: Floats) -> Floats:
        """Sum (s,) of a `value` (r,) over the rings of each stem."""
        return np.asarray(np.add.reduceat(value, self.stems.first[:-1]))

    def _steps(self) -> Floats:
        """Distance (r,) from each ring to the next of its stem, 0 at the last."""
        step = np.r_[np.diff(self.stems.along), 0.0]
        step[self.stems.first[1:] - 1] = 0
        return step


def stem_tree(stems: Stems, sides: int) -> StemTree:
    """Return `stems` with their hosts; rings in the order of Douglas and Peucker (1973), those of collars last."""
    host = np.where(stems.host >= 0, stems.stem[stems.host], -1)
    bend = _bends(stems.first, np.column_stack([stems.centre, stems.radius]))
    bend[(stems.collar != NO_COLLAR) & np.isfinite(bend)] *= 0.1
    return StemTree(stems, host, corners_of(stems.chains, None, sides), bend)


@njit(cache=True, nogil=True)
def _bends(first, point):
    """Area (r,) between the stem and the line that is there without a ring, on both sides of it.

    A stem that is displaced by more than its thickness is not seen in its place, no matter how far it is. No ring has
    more than those that are there before it.
    """
    bend = np.full(len(point), np.inf)
    stack = np.zeros((len(point) + 1, 2), np.int64)
    limit = np.zeros(len(point) + 1)
    for stem in range(len(first) - 1):
        stack[0, 0], stack[0, 1], limit[0], top = first[stem], first[stem + 1] - 1, np.inf, 1
        while top > 0:
            top -= 1
            low, high, most = stack[top, 0], stack[top, 1], limit[top]
            if high - low < 2:
                continue
            farthest, at = -1.0, low + 1
            for i in range(low + 1, high):
                far = _distance(point[i], point[low], point[high])
                if far > farthest:
                    farthest, at = far, i
            chord = np.sqrt(((point[low, :3] - point[high, :3]) ** 2).sum())
            bend[at] = min(most, _SHIFTED * min(0.67 * farthest, 2 * point[at, 3]) * chord)
            stack[top, 0], stack[top, 1], limit[top] = low, at, bend[at]
            stack[top + 1, 0], stack[top + 1, 1], limit[top + 1] = at, high, bend[at]
            top += 2
    return bend


@njit(cache=True, nogil=True)
def _distance(point, begin, end):
    """Distance of `point` (4,), place and radius, to the segment from `begin` to `end`."""
    along = reached = 0.0
    for axis in range(4):
        step = end[axis] - begin[axis]
        along += step * step
        reached += step * (point[axis] - begin[axis])
    share = min(max(reached / max(along, 1e-30), 0.0), 1.0)
    far = 0.0
    for axis in range(4):
        far += (point[axis] - begin[axis] - share * (end[axis] - begin[axis])) ** 2
    return np.sqrt(far)
