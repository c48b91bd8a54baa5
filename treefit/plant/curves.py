"""Curves: chains with the rings that make stems look grown: on bends, around forks, at the foot of the trunk."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant.bends import PIECES, Bend, curve, measure, pieces, rounded, tapered
from treefit.plant.chains import SHORTEST, JoinedChains
from treefit.plant.collars import FLAT, FULL, THICK, put_collar
from treefit.plant.compiling import INNER
from treefit.plant.flare import RINGS, put_foot, widen
from treefit.plant.rings import NO_COLLAR, Rings, apart, between, direction, place_on, put, wood_at

TOLERANCE = 1 / 1600  # distance in plant sizes by which a stem may miss its curve
INSIDE = 0.97  # of its parent's radius that a stem without a collar begins with at most
UNLIKE = 0.008  # by which such stems differ there, or those of one fork would begin with the same ring


@dataclass(frozen=True, eq=False)
class Curves(JoinedChains):
    """Chains whose stems begin on the curves of their parents; `host`, `share` and `ring` are of the rings here."""

    at: NDArray[np.float64]  # (r,) ring of the chains that it lies at or after, and the share of the way to the next
    collar: NDArray[np.float64]  # (r,) 0 on the parent's surface to 1 at the neck, NO_COLLAR elsewhere
    guided: NDArray[np.bool_]  # (s,) stems that begin in the direction of their parent
    chain_ring: NDArray[np.int64]  # ring at or before each one of the chains


def plain_curves(chains: JoinedChains) -> Curves:
    """Return `chains` as they are, all stems straight from ring to ring."""
    rings, stems = len(chains.radius), len(chains)
    return Curves(**vars(chains), at=np.arange(rings, dtype=np.float64), collar=np.full(rings, NO_COLLAR),
                  guided=np.zeros(stems, dtype=np.bool_), chain_ring=np.arange(rings))  # fmt: skip


def curves_of(chains: JoinedChains) -> Curves:
    """Return the stems of `chains` along smooth curves through their rings, none missed by much over TOLERANCE.

    Rings are added where that is seen: a straight thin stem has those of its chain. One that is thick enough gets
    a collar: its rings inside the parent's wood give way to as many on its surface, and one more at least is added.
    """
    if not len(chains):
        return plain_curves(chains)
    first, ring, host, share, guided, rings = _curves(
        chains.first, chains.centre.copy(), chains.radius, chains.level, chains.host, chains.share, chains.size
    )
    return Curves(first, chains.level, rings.centre, rings.radius, host, share, ring[chains.ring], chains.size,
                  rings.at, rings.collar, guided, ring)  # fmt: skip


@njit(cache=True, nogil=True, error_model="numpy")
def _curves(first, old, told, level, old_host, old_share, size):
    """Rings of all stems, the new ring (r,) of each old one, and what Curves has by stem; moves seats in `old`."""
    stems, count = level.shape[0], old.shape[0]
    most = PIECES * count + (len(RINGS) + 4) * stems + 8
    longest = (first[1:] - first[:-1]).max()
    bend = Bend(np.empty((longest, 3)), np.empty(longest), np.empty((longest, 3)), np.empty(longest))
    rings = Rings(np.empty((most, 3)), np.empty(most), np.empty(most), np.empty(most), np.empty(most))
    begin, ring, stem = np.zeros(stems + 1, np.int64), np.zeros(count, np.int64), np.zeros(count, np.int64)
    host, share, guided = np.full(stems, -1, np.int64), np.zeros(stems), np.zeros(stems, np.bool_)
    radius, guide, place, n = np.empty(count), np.zeros(3), np.zeros(3), 0
    for s in range(stems):
        low, last = first[s], first[s + 1] - first[s] - 1
        stem[low : low + last + 1] = s
        begin[s], k, t = n, 0, 0.0
        hosted, grows = 0 <= old_host[s] < low, False
        if hosted:
            grows = level[s] > level[stem[old_host[s]]]
            host[s], share[s] = place_on(rings.at, ring, old_host[s], old_share[s])
            _sit(rings, host[s], share[s], old, low, SHORTEST * size, place)
            direction(rings, host[s], share[s], guide)
        measure(old, low, last, bend)
        guided[s] = hosted and _is_guided(bend.unit[0], guide, grows)
        curve(bend, last, guide, guided[s])
        rounded(told, low, last, bend, radius)
        tapered(radius, low, last, bend)
        if s == 0:
            n, t = put_foot(rings, n, old, radius, low, bend)
        elif grows and not guided[s] and radius[low] > THICK * size:
            wood = wood_at(rings, host[s], share[s], begin[stem[old_host[s]] + 1] - 1)
            fewest = 2 if radius[low] > FULL * size else 1
            n, k, t = put_collar(rings, n, old, radius, low, last, bend, guide, wood, fewest, place)
        n = _put_rest(rings, n, begin[s], old, radius, low, last, k, t, bend, TOLERANCE * size)
        if s == 0:
            widen(rings, n, radius, low, last, bend)
        elif hosted and rings.collar[begin[s]] == NO_COLLAR:
            wood = wood_at(rings, host[s], share[s], host[s])
            rings.radius[begin[s]] = min(rings.radius[begin[s]], INSIDE * wood[0]) * (1 - UNLIKE * (s % 5))
        rings.at[n] = np.inf
        _follow(rings.at, begin[s], ring, low, last)
    begin[stems] = n
    done = Rings(
        rings.centre[:n].copy(), rings.radius[:n].copy(), rings.at[:n].copy(), rings.along[:n].copy(),
        rings.collar[:n].copy(),
    )  # fmt: skip
    return begin, ring, host, share, guided, done


@njit(**INNER)
def _sit(rings, host, share, old, low, shortest, place):
    """Move ring `low` to the parent's curve, unless the stem then had no length."""
    between(rings.centre, host, share, place)
    if apart(place, old[low + 1]) > shortest:
        for axis in range(3):
            old[low, axis] = place[axis]


@njit(**INNER)
def _is_guided(unit, guide, grows):
    """Whether a stem begins in the direction of its parent: a split does, and one that runs along its parent."""
    cosine = unit[0] * guide[0] + unit[1] * guide[1] + unit[2] * guide[2]
    return cosine > 0 and (not grows or 1 - cosine * cosine < FLAT * FLAT)


@njit(**INNER)
def _put_rest(rings, n, begin, old, radius, low, last, k, t, bend, tolerance):
    """Put the rings of a stem from the share t of its segment k on, the first one too when there is none yet."""
    if n == begin:
        n = put(rings, n, begin, old, radius, low, 0, 0.0, bend, NO_COLLAR)
    while k < last:
        count = pieces(radius, low + k, k, bend, tolerance)
        count = max(int(np.ceil(count * (1 - t))), 1)
        for i in range(1, count + 1):
            n = put(rings, n, begin, old, radius, low, k, t + (1 - t) * i / count, bend, NO_COLLAR)
        k, t = k + 1, 0.0
    return n


@njit(**INNER)
def _follow(at, j, ring, low, last):
    """Fill the new ring at or before each of the old rings low .. low + last of a stem that begins at j."""
    for i in range(low, low + last + 1):
        while at[j + 1] <= i:
            j += 1
        ring[i] = j
