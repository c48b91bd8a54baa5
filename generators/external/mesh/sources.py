"""Sources: where each connected piece of wood begins, as the places from which its rings are counted."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.external.mesh.corners import root_of
from generators.external.mesh.holes import holes
from generators.external.mesh.level_sets import distances
from generators.external.mesh.soles import rims, soles

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_LOW = 0.02  # share of the height up to which the lowest pieces are: the largest of them is the trunk
_FOOT = 0.25  # share of the trunk's height up to which the hole is that it stands on


def sources_of(places: Floats, triangles: Ints) -> tuple[NDArray[np.uint8], Ints, int]:
    """Return which places (n,) of a mesh its pieces begin with, the piece (n,) of each place, and which is the trunk.

    A piece begins at its widest hole, the trunk at its lowest; a closed one at one of its ends.
    """
    piece, pieces = pieces_of(triangles, len(places))
    low = np.full((pieces, 3), np.inf)
    high = np.full((pieces, 3), -np.inf)
    _boxes(places, piece, low, high)
    near = low[:, 2] <= low[:, 2].min() + _LOW * np.ptp(places[:, 2])
    trunk = int(np.argmax(np.where(near, ((high - low) ** 2).sum(axis=1), -1.0)))
    foot = low[trunk, 2] + _FOOT * (high[trunk, 2] - low[trunk, 2])
    source, open_ = holes(places, triangles, piece, pieces, trunk, foot)
    if not open_.all():
        _close(places, triangles, piece, open_, trunk, source)
    return source, piece, trunk


@njit(cache=True, nogil=True)
def pieces_of(triangles, count):
    """Connected piece (n,) of each of `count` places, numbered from 0 in order, and how many there are."""
    above = np.arange(count).astype(np.int32)
    for t in range(triangles.shape[0]):
        a = root_of(above, triangles[t, 0])
        for k in range(1, 3):
            b = root_of(above, triangles[t, k])
            if a != b:
                above[max(a, b)] = min(a, b)
                a = min(a, b)
    found = 0
    piece = np.empty(count, np.int32)
    for i in range(count):
        a = root_of(above, i)
        if a == i:
            piece[i] = found
            found += 1
        else:
            piece[i] = piece[a]
    return piece, found


@njit(cache=True, nogil=True)
def _boxes(places, piece, low, high):
    for i in range(places.shape[0]):
        for axis in range(3):
            low[piece[i], axis] = min(low[piece[i], axis], places[i, axis])
            high[piece[i], axis] = max(high[piece[i], axis], places[i, axis])


def _close(
    places: Floats, triangles: Ints, piece: Ints, open_: NDArray[np.bool_], trunk: int, source: NDArray[np.uint8]
) -> None:
    """Mark in `source` (n,) where the pieces without a hole begin: with the level set of an end, seen from the other.

    From a single place level sets are aslant at first; behind as many rings as these have corners they are the rings.
    What shorter pieces begin with is tried out.
    """
    anywhere = np.zeros(len(open_), np.int32)
    anywhere[piece] = np.arange(len(piece), dtype=np.int32)
    ends = _farthest(triangles, piece, open_, anywhere[~open_])[0]
    if not open_[trunk]:
        ends[np.count_nonzero(~open_[:trunk])] = np.argmin(np.where(piece == trunk, places[:, 2], np.inf))
    others = _farthest(triangles, piece, open_, ends)[0]
    level = _farthest(triangles, piece, open_, others)[1]
    rings = level[ends] + 1
    short = np.bincount(piece, minlength=len(open_))[~open_] > (rings - 1) * (rings - 2)
    rims(triangles, level, ends[~short], source)
    soles(places, triangles, ends[short], others[short], source)


def _farthest(triangles: Ints, piece: Ints, open_: NDArray[np.bool_], starts: Ints) -> tuple[Ints, Ints]:
    """Farthest place from each of `starts` on its piece, and the distances (n,)."""
    source = np.zeros(len(piece), np.uint8)
    source[starts] = 1
    level, _, order = distances(triangles, source)
    last = np.zeros(len(open_), np.int32)
    last[piece[order]] = order  # of several values the last one stays
    return last[~open_], level
