"""Leaf choice: which leaves stay and how large they become, so that outline, gaps and density stay."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.lod.view import Extent, View, side_view, top_view
from treefit.plant import Plant

Floats = NDArray[np.float32]
_AZIMUTHS = (22.5, 67.5, 112.5, 157.5)  # others than those by which silhouettes are compared
_LEAF = 3.0  # pixels that a leaf is long
_FEWEST_ROWS, _MOST_ROWS = 160, 512
_PASSES = 12
_LARGEST = 1.2  # of the size at which the leaves that stay have the area of all
_SIZES = 4
_WORTH = np.array([1.0, 0.05, -0.04, -1.5, -0.1], dtype=np.float32)
"""Of a leaf at a pixel without a leaf yet, with fewer than it had, with more; of the sky, of sky covered already."""


@dataclass(frozen=True, eq=False)
class Sights:
    """A plant's leaves as ellipses from several sides: centre and half axes (views, leaves) in pixels."""

    views: tuple[View, ...]
    ellipse: Floats  # (views, leaves, 6): column, row, half length (2), half width (2)
    depth: NDArray[np.int16]  # (views, rows, columns): leaves over each pixel, -1 where there is neither leaf nor wood

    def seen(self, place: Floats) -> Floats:
        """Chance (n,) in (0, 1] that a point of `place` (n, 3) is before all leaves; 1 against the sky."""
        total = np.zeros(len(place), dtype=np.float32)
        for view, depth in zip(self.views, self.depth, strict=True):
            at = np.maximum(view.project(place)[:, :2].astype(np.int64), 0)
            total += 1 / (1 + depth[np.minimum(at[:, 1], view.rows - 1), np.minimum(at[:, 0], view.columns - 1)])
        return np.asarray(total / len(self.views), dtype=np.float32)

    def exposed(self) -> Floats:
        """How many pixels (k,) each leaf covers, those that it shares by the square of its share."""
        return np.asarray(_exposed(self.ellipse, self.depth))


def sights_of(plant: Plant, extent: Extent) -> Sights:
    """Return how the leaves of `plant` are seen from four sides and from above."""
    length = float(np.median(plant.leaf_size[:, 0]))
    rows = int(np.clip(_LEAF * extent.height / max(length, 1e-9), _FEWEST_ROWS, _MOST_ROWS))
    sides = [side_view(extent, degrees, rows) for degrees in _AZIMUTHS]
    views = (*sides, top_view(extent, sides[0].scale))
    half = plant.leaf_size / 2
    along = np.asarray(plant.leaf_axis * half[:, :1], dtype=np.float32)
    across = np.asarray(np.cross(plant.leaf_axis, plant.leaf_normal) * half[:, 1:], dtype=np.float32)
    centre = plant.leaf_position + along
    ellipse = np.stack([_ellipse(view, centre, along, across) for view in views])
    depth = np.zeros((len(views), max(v.rows for v in views), max(v.columns for v in views)), dtype=np.int16)
    _count(ellipse, depth)
    return Sights(views, ellipse, depth)


def _ellipse(view: View, centre: Floats, along: Floats, across: Floats) -> Floats:
    place = view.project(centre)[:, :2]
    axes = [view.project(part)[:, :2] - view.shift[:2] for part in (along, across)]
    return np.column_stack([place, *axes])


def choose_leaves(
    sights: Sights, wood: NDArray[np.bool_], order: NDArray[np.int64], count: int
) -> tuple[NDArray[np.int64], Floats]:
    """Return which `count` leaves stay, and by what they are enlarged (count,).

    `wood` (views, rows, columns) is what the stems cover, `order` (k,) in which leaves of equal worth are taken. A
    leaf is worth the pixels where there was one and is none any more, less the sky that it covers; those of most worth
    are taken first, each at its best size (threshold greedy: Badanidiyuri and Vondrak 2014).
    """
    leaves = sights.ellipse.shape[1]
    mean = np.sqrt(leaves / max(count, 1))
    sizes = np.linspace(1, max(_LARGEST * mean, 1.0), _SIZES).astype(np.float32)
    target = np.where((sights.depth == 0) & ~wood, np.int16(-1), sights.depth)
    chosen, size = _choose(sights.ellipse, target, order, count, sizes, _WORTH)
    index = np.flatnonzero(chosen)
    return index, size[index]


def spread_order(place: Floats) -> NDArray[np.int64]:
    """Order (n,) of points (n, 3), every beginning of it spread evenly: along a Z curve, bits of the rank reversed."""
    low = place.min(axis=0)
    cell = np.asarray((place - low) / max(float(np.ptp(place, axis=0).max()), 1e-9) * 1023, dtype=np.int64)
    code = np.zeros(len(place), dtype=np.int64)
    for bit in range(10):
        for axis in range(3):
            code |= (cell[:, axis] >> bit & 1) << (3 * bit + axis)
    rank = np.argsort(code, kind="stable")
    turned, place_value = np.zeros(len(place), dtype=np.int64), np.arange(len(place))
    for _ in range(len(place).bit_length()):
        turned = turned << 1 | place_value & 1
        place_value >>= 1
    return rank[np.argsort(turned, kind="stable")]


@njit(cache=True, nogil=True)
def _reach(ellipse, size, rows, columns):
    """Rows and columns that an ellipse can touch, and what turns a pixel into its unit circle."""
    x, y, ax, ay, bx, by = ellipse
    ax, ay, bx, by = ax * size, ay * size, bx * size, by * size
    area = ax * by - ay * bx
    wide, high = np.sqrt(ax * ax + bx * bx), np.sqrt(ay * ay + by * by)
    left = max(int(np.ceil(x - wide - np.float32(0.5))), 0)
    right = min(int(np.floor(x + wide - np.float32(0.5))), columns - 1)
    top = max(int(np.ceil(y - high - np.float32(0.5))), 0)
    bottom = min(int(np.floor(y + high - np.float32(0.5))), rows - 1)
    if abs(area) < np.float32(1e-6):
        return 0, -1, 0, -1, x, y, ax, ay, bx, by
    return left, right, top, bottom, x, y, ax / area, ay / area, bx / area, by / area


@njit(cache=True, nogil=True)
def _inside(col, row, x, y, ax, ay, bx, by):
    dx, dy = np.float32(col) + np.float32(0.5) - x, np.float32(row) + np.float32(0.5) - y
    along, across = dx * by - dy * bx, dy * ax - dx * ay
    return along * along + across * across <= np.float32(1)


@njit(cache=True, nogil=True)
def _count(ellipse, depth):
    """Add one at every pixel that a leaf covers."""
    one = np.float32(1)
    for view in range(ellipse.shape[0]):
        for leaf in range(ellipse.shape[1]):
            _stamp(ellipse[view, leaf], one, depth[view])


@njit(cache=True, nogil=True)
def _stamp(ellipse, size, depth):
    left, right, top, bottom, x, y, ax, ay, bx, by = _reach(ellipse, size, depth.shape[0], depth.shape[1])
    for row in range(top, bottom + 1):
        for col in range(left, right + 1):
            if _inside(col, row, x, y, ax, ay, bx, by):
                depth[row, col] += 1


@njit(cache=True, nogil=True)
def _exposed(ellipse, depth):
    worth = np.zeros(ellipse.shape[1], np.float32)
    for view in range(ellipse.shape[0]):
        for leaf in range(ellipse.shape[1]):
            left, right, top, bottom, x, y, ax, ay, bx, by = _reach(
                ellipse[view, leaf], np.float32(1), depth.shape[1], depth.shape[2]
            )
            for row in range(top, bottom + 1):
                for col in range(left, right + 1):
                    if _inside(col, row, x, y, ax, ay, bx, by):
                        there = np.float32(max(depth[view, row, col], 1))
                        worth[leaf] += 1 / (there * there)
    return worth


@njit(cache=True, nogil=True)
def _gain(ellipse, leaf, size, target, depth, worth):
    """What `leaf` is worth over all views."""
    gain = np.float32(0)
    for view in range(ellipse.shape[0]):
        left, right, top, bottom, x, y, ax, ay, bx, by = _reach(
            ellipse[view, leaf], size, depth.shape[1], depth.shape[2]
        )
        for row in range(top, bottom + 1):
            for col in range(left, right + 1):
                if _inside(col, row, x, y, ax, ay, bx, by):
                    wanted, there = target[view, row, col], depth[view, row, col]
                    if wanted < 0:
                        gain += worth[3] if there == 0 else worth[4]
                    elif there == 0:
                        gain += worth[0]
                    else:
                        gain += worth[1] if there < wanted else worth[2]
    return gain


@njit(cache=True, nogil=True)
def _choose(ellipse, target, order, count, sizes, worth):
    """True (k,) for the leaves that stay, and their size (k,)."""
    leaves = ellipse.shape[1]
    depth = np.zeros(target.shape, np.int16)
    chosen = np.zeros(leaves, np.bool_)
    best, size = np.zeros(leaves, np.float32), np.ones(leaves, np.float32)
    step = np.zeros(leaves, np.int64)
    for leaf in range(leaves):
        best[leaf] = -np.inf
        for s in range(len(sizes)):
            gain = _gain(ellipse, leaf, sizes[s], target, depth, worth)
            if gain > best[leaf]:
                best[leaf], step[leaf] = gain, s
    bar = best.max()
    taken = 0
    for turn in range(_PASSES + 1):
        bar = bar * np.float32(0.7) if turn < _PASSES else np.float32(-np.inf)
        for i in range(leaves):
            leaf = order[i]
            if chosen[leaf] or best[leaf] < bar or taken >= count:
                continue
            best[leaf], at = -np.inf, step[leaf]
            for s in range(max(at - 1, 0), min(at + 2, len(sizes))):
                gain = _gain(ellipse, leaf, sizes[s], target, depth, worth)
                if gain > best[leaf]:
                    best[leaf], step[leaf] = gain, s
            if best[leaf] >= bar:
                chosen[leaf], size[leaf] = True, sizes[step[leaf]]
                for view in range(ellipse.shape[0]):
                    _stamp(ellipse[view, leaf], size[leaf], depth[view])
                taken += 1
    return chosen, size
