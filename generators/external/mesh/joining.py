"""Joining: pieces of wood become one tree, each begins at the wood nearest to one of its ends."""

from __future__ import annotations

import heapq
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.external.mesh.near import MOST, bucket, cell_of, grid_of, to_segment
from generators.external.mesh.rings import Rings

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_CELLS = 64  # cells in the extent of the tree at first; where nothing is near, they grow fourfold
_OFFERS = 6  # pieces near to an end of which one may bear it
_THICKER = 1.3  # an end so many times as thick as the other one is where a piece begins


@dataclass(frozen=True, eq=False)
class Joints:
    """Pieces in the order in which they join (p,): by which ring each begins, and on the segment of which ring."""

    start: Ints  # (p,) ring
    host: Ints  # (p,) ring of the segment that bears it, -1 for the trunk


def joints_of(rings: Rings) -> Joints:
    """Return how the pieces of wood with a segment or more join to the trunk."""
    start, end, bearer = _ends(rings.centre, rings.radius, rings.parent, rings.piece, rings.bearer)
    joined = np.zeros(len(start), np.bool_)
    joined[rings.trunk], joined[start < 0] = True, True  # a piece of one ring is no stem
    trunk = np.flatnonzero(rings.piece == rings.trunk)
    feet = trunk[[0, -1]]  # where it begins and what is farthest from there; a short one was seen from any end
    starts, hosts = [feet[[np.argmin(rings.centre[feet, 2])]].astype(np.int32)], [np.array([-1], np.int32)]
    extent = float(np.ptp(rings.centre, axis=0).max())
    cell = extent / _CELLS
    while not joined.all():
        first, items, _ = grid_of(rings.centre, rings.radius, rings.parent, cell)
        ends = np.concatenate([start[~joined], end[~joined]])
        ends = ends[ends >= 0]
        bearers, gaps = _near(rings.centre, rings.radius, rings.parent, rings.piece, bearer, ends, first, items, cell)
        new_start, new_host = _join(rings.piece, ends, bearers, gaps, joined)
        starts.append(new_start)
        hosts.append(new_host)
        if cell > 4 * extent:
            break
        cell *= 4
    return Joints(np.concatenate(starts), np.concatenate(hosts))


@njit(cache=True, nogil=True)
def _ends(centre, radius, parent, piece, bearer):
    """Rings that are the ends of each piece (p,) by which it may begin, -1 for none; its bearer where one is known."""
    pieces = piece.max() + 1
    start, end = np.full(pieces, -1, np.int32), np.full(pieces, -1, np.int32)
    away = np.zeros(radius.shape[0])
    thick_end = np.zeros(pieces)
    thick_start = np.zeros(pieces)
    root = np.full(pieces, -1, np.int32)
    for i in range(radius.shape[0]):
        p = parent[i]
        if p < 0:
            root[piece[i]] = i
            continue
        start[piece[i]] = root[piece[i]]
        away[i] = away[p] + np.sqrt(((centre[i] - centre[p]) ** 2).sum())
        if p == root[piece[i]]:
            thick_start[piece[i]] = max(thick_start[piece[i]], radius[i], radius[p])
        if end[piece[i]] < 0 or away[i] > away[end[piece[i]]]:
            end[piece[i]] = i
            thick_end[piece[i]] = max(radius[i], radius[p]) if parent[p] >= 0 else radius[i]
    known = np.full(pieces, -1, np.int32)
    for k in range(pieces):
        if start[k] >= 0 and bearer[k] >= 0 and start[bearer[k]] >= 0:
            known[k], end[k] = bearer[k], -1
        elif start[k] >= 0:
            if thick_start[k] > _THICKER * thick_end[k]:
                end[k] = -1
            elif thick_end[k] > _THICKER * thick_start[k]:
                start[k] = end[k]
                end[k] = -1
    return start, end, known


@njit(cache=True, nogil=True)
def _near(centre, radius, parent, piece, known, ends, first, items, cell):
    """Nearest segments (e, _OFFERS) of other pieces to each end, one a piece, and how far (e, _OFFERS) they are."""
    mask = first.shape[0] - 2
    bearer = np.full((ends.shape[0], _OFFERS), -1, np.int32)
    gap = np.full((ends.shape[0], _OFFERS), np.inf)
    for n in range(ends.shape[0]):
        i = ends[n]
        x, y, z = cell_of(centre[i], cell)
        for dx in range(-1, 2):
            for dy in range(-1, 2):
                for dz in range(-1, 2):
                    b = bucket(x + dx, y + dy, z + dz, mask)
                    for e in range(first[b], min(first[b + 1], first[b] + MOST)):
                        j = items[e]
                        if piece[j] == piece[i] or (known[piece[i]] >= 0 and piece[j] != known[piece[i]]):
                            continue
                        p = parent[j]
                        share, far = to_segment(centre[i], centre[p], centre[j])
                        # all that reach its own wood are as near: the first to join bears it, nearest to the trunk
                        thick = radius[p] + share * (radius[j] - radius[p])
                        far = max(far - thick - 0.5 * radius[i], 0.0)
                        _offer(bearer[n], gap[n], piece, j, far)
    return bearer, gap


@njit(cache=True, nogil=True)
def _offer(bearer, gap, piece, j, far):
    """Keep the segment `j` when it is among the nearest and the nearest of its piece."""
    worst, most = -1, far
    for k in range(bearer.shape[0]):
        if bearer[k] >= 0 and piece[bearer[k]] == piece[j]:
            if far < gap[k]:
                bearer[k], gap[k] = j, far
            return
        if gap[k] > most:
            worst, most = k, gap[k]
    if worst >= 0:
        bearer[worst], gap[worst] = j, far


@njit(cache=True, nogil=True)
def _join(piece, ends, bearer, gap, joined):
    """Rings with which pieces begin, and the rings of their bearers, in the order of joining: the nearest first."""
    pieces, offers = joined.shape[0], bearer.shape[1]
    first, offered = _offered(piece, bearer, pieces)
    queue = [(0.0, np.int64(0), np.int64(0)) for _ in range(0)]
    pushed = 0
    for p in range(pieces):
        if joined[p]:
            for e in range(first[p], first[p + 1]):
                o = offered[e]
                heapq.heappush(queue, (gap[o // offers, o % offers], np.int64(pushed), np.int64(o)))
                pushed += 1
    starts, hosts, found = np.empty(pieces, np.int32), np.empty(pieces, np.int32), 0
    while len(queue) > 0:
        o = heapq.heappop(queue)[2]
        p = piece[ends[o // offers]]
        if joined[p]:
            continue
        joined[p] = True
        starts[found], hosts[found] = ends[o // offers], bearer[o // offers, o % offers]
        found += 1
        for e in range(first[p], first[p + 1]):
            n = offered[e]
            heapq.heappush(queue, (gap[n // offers, n % offers], np.int64(pushed), np.int64(n)))
            pushed += 1
    return starts[:found].copy(), hosts[:found].copy()


@njit(cache=True, nogil=True)
def _offered(piece, bearer, pieces):
    """Offers (places in `bearer` (e, o), flat) of each piece as a list: `first` (p + 1,), `offered`."""
    flat = bearer.ravel()
    first = np.zeros(pieces + 1, np.int32)
    for j in flat:
        if j >= 0:
            first[piece[j] + 1] += 1
    for p in range(pieces):
        first[p + 1] += first[p]
    filled, offered = first[:-1].copy(), np.empty(first[-1], np.int32)
    for o in range(flat.shape[0]):
        if flat[o] >= 0:
            p = piece[flat[o]]
            offered[filled[p]] = o
            filled[p] += 1
    return first, offered
