"""Tubes: the segments of PyHelios, in the order of their making, become tubes that know on which they begin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.external.pyhelios.primitives import SIDES, Points

CLOSE = 2e-5
"""Distance by the size of the tree under which two points are one."""


@dataclass(frozen=True, eq=False)
class Tubes:
    """Segments (s) of tubes (q), the trunk the last one; a tube comes after all that begin on it."""

    ends: NDArray[np.float64]  # (s, 2, 3) m, foot and tip of each segment
    radii: NDArray[np.float64]  # (s, 2) m
    first: NDArray[np.int64]  # (q,) first segment of a tube
    last: NDArray[np.int64]  # (q,)
    host: NDArray[np.int64]  # (q,) tube that it begins on, -1 for the trunk
    seat: NDArray[np.int64]  # (q,) segment of the host that it begins on


def tubes_of(trunk: Points, branches: Points, forked: bool) -> Tubes:
    """Return the tubes; `trunk` and `branches` (n, 3, 3) are as `build_lines` gives them, `forked` is the trunk's.

    ValueError when a tube begins on no other one.
    """
    rings = np.concatenate([branches, trunk])[:, :2].reshape(-1, SIDES, 2, 3)
    if not forked:
        rings = rings[:-1]  # the package leads the tip of a trunk that does not fork back to its foot
    ends = rings.mean(axis=1, dtype=np.float64)
    radii = np.sqrt(((rings[:, 0] - ends) ** 2).sum(axis=2))
    close = nearness(ends)
    first, last = _cut(ends, radii, len(branches) // SIDES, close)
    host, seat = _seats(ends, first, last, close)
    stray = int((host[:-1] < 0).sum())
    if stray:
        raise ValueError(f"pyhelios: {stray} of {len(host)} stems begin on no other stem")
    return Tubes(ends, radii, first, last, host, seat)


def nearness(ends: NDArray[np.float64]) -> float:
    """Return the distance in m under which two points are one; stems of no length have no numbers."""
    return CLOSE * float((np.nanmax(ends[:, 1], axis=0) - np.nanmin(ends[:, 1], axis=0)).max())


@njit(cache=True, nogil=True)
def _cut(ends, radii, trunk, close):
    """First and last segment of each tube that has a length; `trunk` is the first segment of the trunk."""
    count = len(ends)
    first, last, q = np.empty(count, np.int64), np.empty(count, np.int64), 0
    length = 0.0
    for s in range(count):
        on = s > 0 and s != trunk and far(ends[s, 0], ends[s - 1, 1]) < close
        if not (on and abs(radii[s, 0] - radii[s - 1, 1]) < close):
            q += s > 0 and length > close
            first[q], length = s, 0.0
        length += far(ends[s, 0], ends[s, 1])
        last[q] = s
    return first[: q + 1].copy(), last[: q + 1].copy()


@njit(cache=True, nogil=True)
def _seats(ends, first, last, close):
    """Host and its segment for each tube; those that wait for their host are on a stack."""
    count, waiting = len(first), 0
    host, seat, stack = np.full(count, -1, np.int64), np.full(count, -1, np.int64), np.empty(count, np.int64)
    for tube in range(count):
        while waiting:
            child = stack[waiting - 1]
            found = _seat(ends, first[tube], last[tube], ends[first[child], 0], close)
            if found < 0:
                break
            host[child], seat[child] = tube, found
            waiting -= 1
        stack[waiting] = tube
        waiting += 1
    return host, seat


@njit(cache=True, nogil=True)
def _seat(ends, first, last, point, close):
    """Segment of a tube that has `point` on its axis, but not at the tube's foot; -1 when none has."""
    for s in range(last, first - 1, -1):
        length = reached = 0.0
        for k in range(3):
            step = ends[s, 1, k] - ends[s, 0, k]
            length += step * step
            reached += step * (point[k] - ends[s, 0, k])
        share = min(max(reached / length, 0.0), 1.0) if length > 0 else 0.0
        if s == first and share * np.sqrt(length) < close:
            continue
        off = 0.0
        for k in range(3):
            off += (ends[s, 0, k] + share * (ends[s, 1, k] - ends[s, 0, k]) - point[k]) ** 2
        if off < close * close:
            return s
    return -1


@njit(cache=True, nogil=True)
def far(a, b):
    """Distance of two points."""
    return np.sqrt((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2)
