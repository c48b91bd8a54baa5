"""Skeleton: the tubes of PyHelios become the graph of branches of a Plant; nothing is guessed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.external.pyhelios.tubes import Tubes, far, nearness


@dataclass(frozen=True)
class Forks:
    """How many stems follow each piece of a stem that forks, none: 0; and pieces from a stem's foot to its tips."""

    trunk: bool  # whether the trunk's foot forks into limbs
    splits: tuple[int, ...]  # (4,) by level
    pieces: tuple[int, ...]  # (4,) by level


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Graph of branches in the order of a Plant."""

    position: NDArray[np.float32]  # (v, 3) m
    radius: NDArray[np.float32]  # (v,) m
    parent: NDArray[np.int32]  # (v,)
    level: NDArray[np.int32]  # (v,)


def skeleton_of(tubes: Tubes, forks: Forks) -> Skeleton:
    """Return the graph of the tubes: a stem has its foot on its host's axis, one after a fork goes on from its tip."""
    splits, pieces = np.array(forks.splits), np.array(forks.pieces)
    level, follows = _levels(tubes.host, forks.trunk, splits, pieces)
    numbers, parent, levels = _graph(
        tubes.ends, tubes.radii, tubes.first, tubes.last, tubes.host, tubes.seat, level, follows, nearness(tubes.ends)
    )
    return Skeleton(numbers[:3].T, numbers[3], parent, levels)


@njit(cache=True, nogil=True)
def _levels(host, trunk_forks, splits, pieces):
    """Level of each tube (q,), and whether it follows a fork; of the tubes on a host the last made are those."""
    count = len(host)
    level, piece, seen = np.zeros(count, np.int32), np.ones(count, np.int64), np.zeros(count, np.int64)
    follows = np.zeros(count, np.bool_)
    trunk = count - 1
    for tube in range(count - 2, -1, -1):
        on = host[tube]
        seen[on] += 1
        if on == trunk:
            follows[tube], level[tube] = trunk_forks, 0 if trunk_forks else 1
            continue
        rule = min(level[on], len(splits) - 1)
        follows[tube] = piece[on] < pieces[rule] and seen[on] <= splits[rule]
        level[tube] = level[on] + (0 if follows[tube] else 1)
        if follows[tube]:
            piece[tube] = piece[on] + 1
    return level, follows


@njit(cache=True, nogil=True)
def _graph(ends, radii, first, last, host, seat, level, follows, close):
    """Numbers (4, v) x, y, z, radius; parent (v,), level (v,). From the trunk outwards, so against their order."""
    count = len(first)
    total = count
    for tube in range(count):
        total += last[tube] - first[tube] + 1
    numbers, parent, levels = np.empty((4, total), np.float32), np.empty(total, np.int32), np.empty(total, np.int32)
    above = np.empty(len(ends), np.int32)  # vertex at the tip of a segment
    below = np.empty(len(ends), np.int32)  # vertex at its foot
    n = 0
    for tube in range(count - 1, -1, -1):
        here = -1
        if host[tube] >= 0:
            s = seat[tube]
            here = above[s] if far(ends[s, 1], ends[first[tube], 0]) < close else below[s]
        if not follows[tube]:
            _put(numbers, n, ends[first[tube], 0], radii[first[tube], 0])
            parent[n], levels[n], here = here, level[tube], n
            n += 1
        for s in range(first[tube], last[tube] + 1):
            _put(numbers, n, ends[s, 1], radii[s, 1])
            parent[n], levels[n] = here, level[tube]
            below[s], above[s], here = here, n, n
            n += 1
    return numbers[:, :n].copy(), parent[:n].copy(), levels[:n].copy()


@njit(cache=True, nogil=True)
def _put(numbers, n, point, radius):
    numbers[0, n], numbers[1, n], numbers[2, n], numbers[3, n] = point[0], point[1], point[2], radius
