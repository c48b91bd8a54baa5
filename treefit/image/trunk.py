"""Trunk by geometry: the narrow column under a crown, found from the outline of a tree alone."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from treefit.image.picture import Region

SEARCH_SHARE = 0.4
FOOT_SHARE = 0.02
WIDEST_SHARE = 0.34
WIDENING = 1.9
FLARE = 3.0
LEAST_LENGTH = 0.02


def trunk_column(tree: Region) -> Region:
    """(h, w) bool: the column from the foot of `tree` up to its crown; empty when the crown stands on the ground."""
    trunk = np.zeros_like(tree)
    rows = np.flatnonzero(tree.any(axis=1))
    if len(rows) == 0:
        return trunk
    top, foot = int(rows[0]), int(rows[-1])
    height = foot - top + 1
    crown_width = float(np.percentile(tree[top : foot + 1].sum(axis=1), 90))
    start = _narrowest_row(tree, foot, height)
    width = _run_widths(tree[start]).max()
    if width > WIDEST_SHARE * crown_width:
        return trunk
    first = _longest_run(tree[start])
    _climb(tree, trunk, range(start, top, -1), first, limit=max(WIDENING * width, width + 2))
    _climb(tree, trunk, range(start + 1, foot + 1), first, limit=FLARE * width)
    return trunk if trunk.any(axis=1).sum() >= LEAST_LENGTH * height else np.zeros_like(tree)


def _narrowest_row(tree: Region, foot: int, height: int) -> int:
    """Row of the lower part where the tree is thinnest; the last rows are left out, being frayed."""
    last = foot - int(FOOT_SHARE * height)
    rows = range(max(last - int(SEARCH_SHARE * height), 0), last + 1)
    widths = np.array([tree[row].sum() for row in rows], dtype=float)
    smooth = ndimage.uniform_filter1d(widths, max(1, height // 60), mode="nearest")
    smooth[widths == 0] = np.inf
    # of equally thin rows the lowest: it is surely trunk
    return rows[len(smooth) - 1 - int(np.argmin(smooth[::-1]))]


def _climb(tree: Region, trunk: Region, rows: range, first: tuple[int, int], limit: float) -> None:
    """Mark run after run of `rows` in `trunk` as long as they overlap and stay within `limit` pixels of width."""
    left, right = first
    for row in rows:
        run = _overlapping_run(tree[row], left, right)
        if run is None or run[1] - run[0] > limit:
            return
        left, right = run
        trunk[row, left:right] = True


def _overlapping_run(row: Region, left: int, right: int) -> tuple[int, int] | None:
    """Run [start, stop) of `row` that shares most columns with [left, right)."""
    shared = [(min(stop, right) - max(start, left), start, stop) for start, stop in _runs(row)]
    best = max(shared, default=(0, 0, 0))
    return (best[1], best[2]) if best[0] > 0 else None


def _longest_run(row: Region) -> tuple[int, int]:
    runs = _runs(row)
    return runs[int(np.argmax([stop - start for start, stop in runs]))]


def _run_widths(row: Region) -> np.ndarray:
    return np.array([stop - start for start, stop in _runs(row)])


def _runs(row: Region) -> list[tuple[int, int]]:
    """Runs [start, stop) of True in `row`."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], row, [False])).astype(np.int8)))
    return [(int(start), int(stop)) for start, stop in zip(edges[::2], edges[1::2], strict=True)]
