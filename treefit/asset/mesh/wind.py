"""Wind: how much each place of a plant sways, in which beat, and how much it flutters."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.mesh.stems import Stems

_MORE_UP = 1.5  # exponent of the sway: a bent beam moves most at its end

Floats = NDArray[np.float64]


def sway(stems: Stems) -> tuple[Floats, Floats]:
    """Bend (r,) and phase (r,) in [0, 1] of the rings.

    Wood bends with the length from the root, thin wood more: d(bend) = d(length) / sqrt(radius), 1 at the most. All
    that grows on the trunk moves in a beat of its own, which the place where it begins tells; its first ring is in
    the trunk's beat, 0, so that joints stay closed.
    """
    bend, phase = _sway(stems.first, stems.level, stems.centre, stems.radius, stems.along, stems.host, stems.share,
                        stems.stem)  # fmt: skip
    return (bend / max(float(bend.max(initial=0.0)), 1e-12)) ** _MORE_UP, phase


@njit(cache=True, nogil=True)
def _sway(first, level, centre, radius, along, host, share, stem):
    bend, phase = np.zeros(along.shape[0]), np.zeros(along.shape[0])
    for s in range(first.shape[0] - 1):
        low, j = first[s], host[s]
        beat = 0.0
        if j >= 0:
            bend[low] = bend[j] + (share[s] * (bend[j + 1] - bend[j]) if share[s] > 0 else 0.0)
            beat = phase[first[stem[j] + 1] - 1]
            phase[low] = phase[j]
            if beat == 0.0 and level[s] > 0:
                beat = _beat(centre[low], centre[first[s + 1] - 1])
        for i in range(low + 1, first[s + 1]):
            thin = np.sqrt((radius[i] + radius[i - 1]) / 2)
            bend[i] = bend[i - 1] + (along[i] - along[i - 1]) / max(thin, 1e-6)
            phase[i] = beat
    return bend, phase


@njit(cache=True, nogil=True)
def _beat(begin, end):
    """Number in (0, 1] from two places (3,) to the centimetre, so that it is that of the branch at every detail."""
    h = np.uint32(2166136261)
    for axis in range(3):
        for place in (begin, end):
            cell = np.uint32(np.int64(np.floor(place[axis] * 100 + 0.5)) & 0xFFFFFFFF)
            h = np.uint32((np.uint64(h ^ cell) * np.uint64(16777619)) & np.uint64(0xFFFFFFFF))
    h ^= h >> np.uint32(15)
    return ((h & np.uint32(0xFFFF)) + 1.0) / 65536.0
