"""Thin wood: fewer stems of fewer rings with fewer corners, for a count of triangles."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.lod.stem_tree import StemTree
from treefit.plant.rings import NO_COLLAR
from treefit.plant.seats import share_along

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]

_MOST_CORNERS = 8
_STEPS = 40
_MISFIT = 0.7
"""How far the outline of a prism of k corners is from a round one, in its thickness, is about this / k^2."""


@dataclass(frozen=True, eq=False)
class ThinWood:
    """The stems (s,) and rings (r,) that a level keeps."""

    first: Ints  # (s + 1,) where stems begin among the rings
    ring: Ints  # (r,) which of the plant's rings each one is
    centre: Floats  # (r, 3) m, bases on the thinned stems that carry them
    radius: Floats  # (r,) m
    level: NDArray[np.int32]  # (s,)
    corners: Ints  # (s,) of its rings
    whole: Ints  # (s,) corners that its rings have in the whole model
    blunt: Flags  # (s,) whether its last ring is one, or a point

    @property
    def triangles(self) -> int:
        """Triangles of its cones."""
        return int(_cost(self.corners, np.diff(self.first), self.blunt).sum())

    def only(self, chosen: Flags) -> ThinWood:
        """The `chosen` (s,) stems alone."""
        count = np.diff(self.first)
        ring = np.repeat(chosen, count)
        return ThinWood(
            np.r_[0, np.cumsum(count[chosen])], self.ring[ring], self.centre[ring], self.radius[ring],
            self.level[chosen], self.corners[chosen], self.whole[chosen], self.blunt[chosen],
        )  # fmt: skip


def thin_wood(tree: StemTree, seen: Floats, budget: int) -> ThinWood:
    """Return the wood of `tree` in at most `budget` triangles, the trunk at least.

    `seen` (r,) in (0, 1] is how much each ring is seen. Rings, corners and stems are kept as long as each of their
    triangles is worth more than a price, in m2 by which the picture would change; the price is found by bisection.
    """
    weight = tree.sum(seen) / np.diff(tree.stems.first)
    tree = replace(tree, bend=tree.bend * seen)
    area = tree.area() * weight
    low, high = 1e-12, float(area.max()) + 1e-12
    best = _kept(tree, area, weight, high)
    for _ in range(_STEPS):
        price = math.sqrt(low * high)
        found = _kept(tree, area, weight, price)
        if found.cost <= budget:
            best, high = found, price
        else:
            low = price
        if high / low < 1.001:
            break
    return _thinned(tree, best)


@dataclass(frozen=True, eq=False)
class _Kept:
    ring: Flags
    stem: Flags
    corners: Ints
    blunt: Flags
    cost: int


def _kept(tree: StemTree, area: Floats, weight: Floats, price: float) -> _Kept:
    """What is worth its triangles at `price`."""
    stems = tree.stems
    counts = np.diff(stems.first)
    corners = np.full(len(tree), 3)
    gain = np.array([_MISFIT * (1 / k**2 - 1 / (k + 1) ** 2) for k in range(3, _MOST_CORNERS)])
    for _ in range(2):  # corners cost by the rings, rings by the corners
        ring = tree.bend > np.repeat(price * 2 * corners, counts)
        rings = np.add.reduceat(ring.astype(np.int64), stems.first[:-1])
        corners = 3 + (area[:, None] * gain > price * (2 * rings - 3)[:, None]).sum(axis=1)
        corners = np.minimum(corners, tree.corners)
    tip = stems.radius[stems.first[1:] - 1] * tree.length() / (rings - 1) * weight
    blunt = tip > price * corners
    cost = _cost(corners, rings, blunt)
    stem = _upwards(tree.host, area / cost) > price
    stem[0] = True
    return _Kept(ring, stem, corners, blunt, int(cost[stem].sum()))


def _cost(corners: Ints, rings: Ints, blunt: Flags) -> Ints:
    """Triangles of each stem (s,): two a side and segment, one in a last segment that ends in a point."""
    return np.asarray(corners * (2 * rings - np.where(blunt, 2, 3)))


@njit(cache=True, nogil=True)
def _upwards(host, worth):
    """Worth (s,) of each stem or of the best one that it carries."""
    for stem in range(len(host) - 1, -1, -1):
        if host[stem] >= 0:
            worth[host[stem]] = max(worth[host[stem]], worth[stem])
    return worth


def _thinned(tree: StemTree, found: _Kept) -> ThinWood:
    stems = tree.stems
    centre, radius = stems.centre.copy(), stems.radius.copy()
    _seat(stems.first, stems.host, stems.share, stems.stem, found.ring, found.stem, centre)
    first = stems.first[:-1]
    _necks(stems.first, stems.collar, stems.radius, radius)
    ring = found.ring & np.repeat(found.stem, np.diff(stems.first))
    counts = np.add.reduceat(ring.astype(np.int64), first)[found.stem]
    return ThinWood(
        np.r_[0, np.cumsum(counts)], np.flatnonzero(ring), centre[ring], radius[ring], stems.level[found.stem],
        found.corners[found.stem], tree.corners[found.stem], found.blunt[found.stem],
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _necks(first, collar, radius, out):
    """Begin every stem that has a collar as thick as it is beyond it."""
    for stem in range(len(first) - 1):
        if collar[first[stem]] != NO_COLLAR:
            neck = first[stem]
            while neck + 1 < first[stem + 1] and collar[neck] != NO_COLLAR:
                neck += 1
            out[first[stem] : neck] = radius[neck]


@njit(cache=True, nogil=True)
def _seat(first, host, share, stem_of, kept, stems, centre):
    """Move the base of every stem onto the axis of its thinned host, which is done before it."""
    for stem in range(len(stems)):
        if host[stem] < 0 or not stems[stem]:
            continue
        low, last = host[stem], first[stem_of[host[stem]] + 1] - 1
        high = min(low + 1, last) if share[stem] > 0 else low
        while not kept[low]:
            low -= 1
        while not kept[high]:
            high += 1
        base, begin, end = centre[first[stem]], centre[low], centre[high]
        part = share_along(base, begin, end)
        for axis in range(3):
            centre[first[stem], axis] = begin[axis] + part * (end[axis] - begin[axis])
