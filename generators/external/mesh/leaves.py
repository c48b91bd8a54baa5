"""Leaves: flat pieces of foliage become the leaves of a Plant, each hung on the wood nearest to it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.external.mesh.blades import blades_of, normals_of, single_sided
from generators.external.mesh.near import grid_of, nearest
from generators.external.mesh.planes import planes
from generators.external.mesh.rings import Rings
from generators.external.mesh.vectors import cross, dot, row

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_CELLS = 40  # cells in the extent of the wood at first, in which wood near to a leaf is looked for


@dataclass(frozen=True, eq=False)
class Leaves:
    """Leaves as in a Plant."""

    position: Floats  # (k, 3) m
    axis: Floats  # (k, 3) unit
    normal: Floats  # (k, 3) unit
    size: Floats  # (k, 2) m


def leaves_of(places: Floats, triangles: Ints, rings: Rings) -> Leaves:
    """Return the leaves that triangles (t, 3) of foliage are, on the wood of `rings`.

    A leaf is as long and wide as its piece is, but its ellipse no larger than its triangles.
    """
    triangles = triangles[single_sided(triangles)]
    normals = normals_of(places, triangles)
    seen = (normals**2).sum(axis=1) > 0
    if not seen.all():
        triangles, normals = triangles[seen], normals[seen]
    if not len(triangles):
        none = np.zeros((0, 3))
        return Leaves(none, none, none, np.zeros((0, 2)))
    leaf, count = blades_of(triangles, normals)
    middle, normal, long, area = planes(places, triangles, normals, leaf, count)
    wood = _wood_near(middle, rings)
    return Leaves(*_hung(places, triangles, leaf, middle, normal, long, area, wood))


def _wood_near(middle: Floats, rings: Rings) -> Floats:
    """Nearest wood (k, 3) of each leaf."""
    found = np.full_like(middle, np.nan)
    extent = float(np.ptp(rings.centre, axis=0).max())
    cell = extent / _CELLS
    while np.isnan(found[:, 0]).any() and cell < 8 * extent:
        first, items, _ = grid_of(rings.centre, rings.radius, rings.parent, cell)
        nearest(middle, rings.centre, rings.parent, first, items, cell, found)
        cell *= 2
    return np.where(np.isnan(found), rings.centre[:1], found)


@njit(cache=True, nogil=True)
def _hung(places, triangles, leaf, middle, normal, long, area, wood):
    """Position, axis, normal (k, 3) and size (k, 2): each leaf begins at its end nearest to the wood."""
    count = area.shape[0]
    position, axis, size = np.empty((count, 3)), np.empty((count, 3)), np.empty((count, 2))
    low, high = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    for t in range(leaf.shape[0]):
        k = leaf[t]
        m, u = row(middle, k), row(long, k)
        v = cross(row(normal, k), u)
        for c in range(3):
            p = row(places, triangles[t, c])
            step = p[0] - m[0], p[1] - m[1], p[2] - m[2]
            along, beside = dot(step, u), dot(step, v)
            low[k, 0], high[k, 0] = min(low[k, 0], along), max(high[k, 0], along)
            low[k, 1], high[k, 1] = min(low[k, 1], beside), max(high[k, 1], beside)
    for k in range(count):
        length, width = high[k, 0] - low[k, 0], high[k, 1] - low[k, 1]
        m, u, w = row(middle, k), row(long, k), row(wood, k)
        v = cross(row(normal, k), u)
        away = m[0] - w[0], m[1] - w[1], m[2] - w[2]
        beyond, aside = dot(away, u), dot(away, v)
        along, beside = 0.5 * (low[k, 0] + high[k, 0]), 0.5 * (low[k, 1] + high[k, 1])
        if width > 0.95 * length and abs(aside) > abs(beyond):  # a square hangs either way
            u, v, beyond, length, width, along, beside = v, u, aside, width, length, beside, along
        turn = -1.0 if beyond < 0 else 1.0
        for x in range(3):
            position[k, x] = m[x] + (along - 0.5 * turn * length) * u[x] + beside * v[x]
            axis[k, x] = turn * u[x]
        size[k, 0], size[k, 1] = length, min(width, 4 / np.pi * area[k] / length)
    return position, axis, normal, size
