"""Hugging: the rings of a collar laid on the parent's wood, so that a branch looks grown out of it."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.mesh.lobes import Lobes
from treefit.asset.mesh.stems import Stems
from treefit.plant.collars import RUN, SLANT, SWELL

WIDER = 1.2  # of a collar across the parent, in radii
SUNK = 0.2  # of the lowest ring in the parent's wood, in radii
NECK = 1.06  # of the neck, in radii
SMOOTH = 0.85  # share of the parent's normal on its surface

Floats = NDArray[np.float64]


def hug(
    stems: Stems, start: NDArray[np.int64], sides: NDArray[np.int64], lobes: Lobes | None, place: Floats,
    normal: Floats, ahead: Floats,
) -> None:  # fmt: skip
    """Lay the corners of collars on the surface of the parents.

    `start` (r,) is the first corner of each ring, -1 where it has none, `sides` (s,) corners of rings by stem. Changes
    places and normals (c, 3); `ahead` (c,) becomes how far (m) corners lie before the place of their ring.
    """
    depth, count = (np.zeros(len(stems.radius)), 0) if lobes is None else (lobes.depth, lobes.count)
    _hug(
        stems.first, stems.centre, stems.radius, stems.along, stems.tangent, stems.side, stems.stem, stems.collar,
        stems.host, stems.share, start, sides, depth, count, place, normal, ahead,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _hug(first, centre, radius, along, tangent, side, stem, collar, host, share, start, sides, depth, lobes, place,
         normal, ahead):  # fmt: skip
    for s in range(host.shape[0]):
        low = first[s]
        if collar[low] != 0.0 or start[low] < 0:
            continue
        end, h = low, host[s]
        while end + 1 < first[s + 1] and collar[end + 1] >= 0:
            end += 1
        seat, d = centre[low], _unit(centre[end] - centre[low])
        at = along[h] + (share[s] * (along[h + 1] - along[h]) if share[s] > 0 else 0.0)
        t, wide = _on(centre, radius, tangent, h, share[s])
        cosine = (d * t).sum()
        n = _unit(d - cosine * t)
        sine = (d * n).sum()
        across, up = _cross(t, n), _unit(t - cosine * d)
        right = _unit(side[low] - (side[low] * d).sum() * d)
        top = _cross(d, right)
        far = np.sqrt(((centre[end] - seat) ** 2).sum())
        count = sides[s]
        run = RUN * min(max((count - 4) / 3, 0.0), 1.0)
        for c in range(count + 1):
            turn = 2 * math.pi * (c % count) / count
            o = math.cos(turn) * right + math.sin(turn) * top
            x = min(max(WIDER * radius[low] * (o * across).sum(), -0.96 * wide), 0.96 * wide)
            y = np.sqrt(wide * wide - x * x)
            rise = (o * up).sum()
            swell = SWELL + run * max(-rise * cosine, 0.0)
            z = (y * cosine + swell * radius[low] * rise) / sine
            foot, skin = _surface(first, centre, radius, along, side, stem[h], sides[stem[h]], depth, lobes,
                                  h, at + z, _unit(y * n + x * across), SUNK * radius[low])  # fmt: skip
            slant = SWELL * radius[low] * rise * cosine / sine
            neck = seat + d * (far + SLANT * slant) + NECK * radius[end] * o
            bow = neck - d * (far + SLANT * slant - y / sine - slant * NECK / SWELL)
            for i in range(low, end + 1):
                w, corner = collar[i], start[i] + c
                v = 1 - w
                here = v * v * foot + 2 * v * w * bow + w * w * neck
                place[corner] = here
                normal[corner] = _unit(SMOOTH * v * skin + (1 - SMOOTH * v) * o)
                ahead[corner] = ((here - seat) * d).sum() - along[i]


@njit(cache=True, nogil=True)
def _on(centre, radius, tangent, h, share):
    """Direction (3,) and radius of a stem between its rings h and h + 1."""
    if share == 0:
        return tangent[h].copy(), radius[h]
    return _unit(centre[h + 1] - centre[h]), radius[h] + share * (radius[h + 1] - radius[h])


@njit(cache=True, nogil=True)
def _surface(first, centre, radius, along, side, s, count, depth, lobes, j, at, outward, sunk):
    """Point (3,) and normal (3,) of stem s, whose rings have `count` corners, `at` m along it and `outward` of it.

    `j` is a ring near it; the point lies `sunk` m in the wood.
    """
    while j > first[s] and along[j] > at:
        j -= 1
    while j + 2 < first[s + 1] and along[j + 1] <= at:
        j += 1
    q = min(max((at - along[j]) / (along[j + 1] - along[j]), 0.0), 1.0)
    axis = centre[j] + q * (centre[j + 1] - centre[j])
    t = _unit(centre[j + 1] - centre[j])
    w = _unit(outward - (outward * t).sum() * t)
    right = _unit(side[j] - (side[j] * t).sum() * t)
    angle = math.atan2((w * _cross(t, right)).sum(), (w * right).sum()) % (2 * math.pi)
    step = 2 * math.pi / count
    before = math.floor(angle / step) * step
    low, high = 1.0, 1.0
    swell = depth[j] + q * (depth[j + 1] - depth[j])
    if swell > 0:
        low, high = 1 + swell * math.sin(lobes * before), 1 + swell * math.sin(lobes * (before + step))
    wide = radius[j] + q * (radius[j + 1] - radius[j])
    wide *= low * high * math.sin(step) / (low * math.sin(angle - before) + high * math.sin(before + step - angle))
    return axis + (wide - sunk) * w, w


@njit(cache=True, nogil=True)
def _unit(vector):
    return vector / max(np.sqrt((vector**2).sum()), 1e-12)


@njit(cache=True, nogil=True)
def _cross(a, b):
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
