"""Hanging: where on the wood each leaf of a plant hangs, which the plant does not say."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from treefit.asset.mesh.stems import Stems
from treefit.plant import Plant
from treefit.plant.rings import place_on

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Hanging:
    """Places of leaves (k,) on the stems."""

    ring: NDArray[np.int64]  # (k,) at or before which a leaf hangs
    share: Floats  # (k,) of the way to the next ring
    moved: Floats  # (k, 3) m from where the plant's wood is to where the curve of the stem is

    def of(self, values: Floats) -> Floats:
        """Values (k,) of leaves from those of rings (r,)."""
        onward = np.minimum(self.ring + 1, len(values) - 1)
        return np.asarray(values[self.ring] * (1 - self.share) + values[onward] * self.share)


def hanging_of(plant: Plant, stems: Stems) -> Hanging:
    """Return where the leaves hang: on the segments at the nearest vertex. Needs a stem."""
    chains = stems.chains
    seat = np.ascontiguousarray(plant.leaf_position, dtype=np.float64)
    _, vertex = cKDTree(plant.position).query(seat)
    ends = np.zeros(len(chains.radius), dtype=np.bool_)
    ends[chains.first[1:] - 1] = True
    at = np.append(stems.at, np.inf)
    new = stems.chain_ring
    return Hanging(*_hang(seat, chains.ring[vertex], chains.centre, ends, at, new, stems.centre))


@njit(cache=True, nogil=True)
def _hang(seat, near, old, ends, at, new, centre):
    count = seat.shape[0]
    ring, share, moved = np.zeros(count, np.int64), np.zeros(count), np.zeros((count, 3))
    for leaf in range(count):
        best, segment, part = np.inf, near[leaf], 0.0
        for i in (near[leaf] - 1, near[leaf]):
            if i < 0 or ends[i]:
                continue
            step, to = old[i + 1] - old[i], seat[leaf] - old[i]
            t = min(max((step * to).sum() / max((step**2).sum(), 1e-30), 0.0), 1.0)
            far = ((to - t * step) ** 2).sum()
            if far < best:
                best, segment, part = far, i, t
        j, q = place_on(at, new, segment, part)
        ring[leaf], share[leaf] = j, q
        for axis in range(3):
            there = old[segment, axis] + (part * (old[segment + 1, axis] - old[segment, axis]) if part > 0 else 0.0)
            here = centre[j, axis] + (q * (centre[j + 1, axis] - centre[j, axis]) if q > 0 else 0.0)
            moved[leaf, axis] = here - there
    return ring, share, moved
