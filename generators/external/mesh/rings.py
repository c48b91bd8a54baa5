"""Rings: each connected piece of wood as a curve skeleton, by level sets of the distance from where it begins.

The idea is that of Verroust and Lazarus (Extracting skeletal curves from 3D scattered data, 2000): points as far from
the source as each other, as long as they hang together, are one ring around the axis. Distance is counted in edges.
So, where a mesh is made of rings, those are the level sets, however long the triangles between them are.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from generators.external.mesh.bumps import worthy
from generators.external.mesh.cutting import cut
from generators.external.mesh.girth import measured
from generators.external.mesh.level_sets import distances, level_sets, members_of, weights

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


_BESIDE = 1e-3  # weight of a place at the foot of another stem


@dataclass(frozen=True, eq=False)
class Rings:
    """Rings (m,) of all pieces; a ring's parent is the one before it on its piece and has a lower index."""

    centre: Floats  # (m, 3) m
    radius: Floats  # (m,) m, that of the circle whose silhouette is as wide
    parent: Ints  # (m,), -1 where a piece begins
    piece: Ints  # (m,) which piece of the mesh
    trunk: int  # which of the pieces is the trunk
    bearer: Ints  # (p,) piece that is known to bear each piece, -1 for those of which that is not known


def rings_of(places: Floats, triangles: Ints, source: NDArray[np.uint8], piece: Ints, trunk: int) -> Rings:
    """Return the rings of a mesh of `places` (n, 3), `triangles` (t, 3); `source` (n,) is 1 where a piece begins.

    Connected pieces (n,) are numbered from 0, the `trunk` is one of them; each begins somewhere. Where one of them has
    forks all are cut, and each stem is a piece.
    """
    level, before, order = distances(triangles, source)
    none = np.full(int(piece.max()) + 1, -1, np.int32)
    rings = _rings(places, triangles, level, before, order, source, piece, trunk, none)
    forked = _forked(rings, len(none))
    if not forked.any():
        return rings
    apart = forked[piece]
    mine = apart[triangles[:, 0]]
    stems = cut(places, triangles[mine], before, order, source)
    triangles = np.concatenate([triangles[~mine], stems.triangles])
    foot = int(np.argmax((piece == trunk) & (source == 1) & ((stems.source == 1) | ~apart)))
    source = np.where(apart, stems.source, source)
    piece = np.where(apart, len(none) + stems.stem, piece).astype(np.int32)
    bearer = np.concatenate([none, np.where(stems.bearer >= 0, len(none) + stems.bearer, -1)]).astype(np.int32)
    level, before, order = distances(triangles, source)
    return _rings(
        places, triangles, level, before, order, source, piece, int(piece[foot]), bearer, stems.beside & apart
    )


def _forked(rings: Rings, count: int) -> NDArray[np.bool_]:
    """Whether each of `count` pieces has a fork: a ring on which two follow that others follow on."""
    follow = np.bincount(rings.parent + 1, minlength=len(rings.parent) + 1)[1:]
    inner = rings.parent[follow > 0]
    forks = np.bincount(inner[inner >= 0], minlength=len(rings.parent)) > 1
    return np.bincount(rings.piece[forks], minlength=count) > 0


def _rings(
    places: Floats, triangles: Ints, level: Ints, before: Ints, order: Ints, source: NDArray[np.uint8], piece: Ints,
    trunk: int, bearer: Ints, beside: NDArray[np.bool_] | None = None,
) -> Rings:  # fmt: skip
    """Rings of pieces without forks, by the level of each place (n,), the place before it and the order of levels."""
    ring, parent, pieces = level_sets(triangles, level, before, order, source, piece)
    first, members = members_of(ring, order, len(parent))
    weight, loose = weights(places, triangles, level), np.zeros(len(parent), np.bool_)
    if beside is not None:
        weight[beside] *= _BESIDE
        loose = np.bincount(ring[ring >= 0], ~beside[ring >= 0], len(parent)) < 3  # no round
    centre, radius = measured(places, weight, first, members, parent)
    kept = worthy(centre, radius, parent, loose)
    place = (np.cumsum(kept) - 1).astype(np.int32)
    above = parent[kept]
    parent = np.where(above >= 0, place[above], -1).astype(np.int32)
    return Rings(centre[kept], radius[kept], parent, pieces[kept], trunk, bearer)
