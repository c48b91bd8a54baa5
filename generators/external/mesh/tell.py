"""Telling apart: which triangles of a tree are wood and which are foliage."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.external.mesh.blades import flatness, normals_of, single_sided
from generators.external.mesh.parts import Part, Parts
from generators.external.mesh.rules import Mesh
from generators.external.mesh.sources import pieces_of
from generators.external.mesh.weld import weld

PLANE = 0.9
"""Sum of the area normals by the area above which a connected piece is a leaf when no name tells what it is."""


@dataclass(frozen=True, eq=False)
class Body:
    """Triangles (t, 3) of different places (n, 3)."""

    places: NDArray[np.float64]
    triangles: NDArray[np.int32]


def tell_apart(parts: Parts, rules: Mesh) -> tuple[Body, Body, int]:
    """Return the wood and the foliage of `parts`, and the count of mesh vertices of the wood.

    Names and alpha tell first, as in `rules`, then the shape of each connected piece.
    """
    extent = _extent(parts)
    wood, foliage = [], []
    for part in parts:
        kind = rules.kind(part.names, part.see_through)
        if kind is None:
            plane = _plane(part, extent)
            wood.append((part, part.triangles[~plane]))
            foliage.append((part, part.triangles[plane]))
        else:
            (wood if kind == "wood" else foliage).append((part, part.triangles))
    if not sum(len(triangles) for _, triangles in wood):
        names = ", ".join(dict.fromkeys(repr(next(filter(None, part.names))) for part in parts[:5]))
        raise ValueError(f"mesh: has no wood, only foliage ({names}); name what is wood by a pattern: mesh.wood=...")
    count = sum(int(np.bincount(triangles.ravel()).astype(bool).sum()) for _, triangles in wood)
    return _body(wood, extent), _body(foliage, extent), count


def _extent(parts: Parts) -> float:
    box = np.array([[np.inf] * 3, [-np.inf] * 3])
    for part in parts:
        _widen(box, part.places)
    extent = float((box[1] - box[0]).max())
    if extent <= 0:
        raise ValueError("mesh: all of its vertices are at one place")
    return extent


@njit(cache=True, nogil=True)
def _widen(box, places):
    """Let a box (2, 3) hold `places` too."""
    for i in range(places.shape[0]):
        for axis in range(3):
            box[0, axis] = min(box[0, axis], places[i, axis])
            box[1, axis] = max(box[1, axis], places[i, axis])


def _plane(part: Part, extent: float) -> NDArray[np.bool_]:
    """Whether each triangle (t,) of a part belongs to a connected piece that is plane."""
    places, label = weld(part.places, extent)
    triangles = label[part.triangles]
    piece, pieces = pieces_of(triangles, len(places))
    group = piece[triangles[:, 0]]
    flat = flatness(normals_of(places, triangles), group, pieces)
    return np.asarray(flat[group] > PLANE)


def _body(found: list[tuple[Part, NDArray[np.int32]]], extent: float) -> Body:
    """Triangles of parts with their corners welded, those without an area left out; places that none has are left."""
    found = [(part, triangles) for part, triangles in found if len(triangles)]
    if not found:
        return Body(np.zeros((0, 3)), np.zeros((0, 3), np.int32))
    starts = np.cumsum([0, *(len(part.places) for part, _ in found)])
    triangles = np.concatenate([own + start for (_, own), start in zip(found, starts[:-1], strict=True)])
    places = np.concatenate([part.places for part, _ in found])
    used = np.zeros(len(places), bool)
    used[triangles.ravel()] = True
    if not used.all():
        triangles = (np.cumsum(used) - 1)[triangles]
        places = places[used]
    places, label = weld(places, extent)
    triangles = label[triangles]
    return Body(places, triangles[single_sided(triangles)])
