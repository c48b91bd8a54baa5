"""Cones: stems as open tubes or cones, with the fewest triangles that look as thick as the real ones."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from treefit.asset.lod.thin_wood import ThinWood
from treefit.asset.mesh.mesh import Mesh, unit
from treefit.asset.mesh.skin import Skin
from treefit.asset.mesh.stems import Stems

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def cones(wood: ThinWood, stems: Stems, skin: Skin) -> Mesh:
    """Return the `wood`, some of the rings of `stems`, whose bark and wind `skin` tells.

    The last ring of a stem that is not blunt is a point. What the point takes from the last segment is given to its
    other end, within bounds. Feet are open: they stand in wood or in the ground. The seam is doubled.
    """
    count = np.diff(wood.first)
    is_tip = np.zeros(len(wood.ring), dtype=bool)
    is_tip[(wood.first[1:] - 1)[~wood.blunt]] = True
    width = np.where(is_tip, 1, np.repeat(wood.corners + 1, count))  # corners of every ring
    start = np.r_[0, np.cumsum(width)[:-1]]
    at = np.repeat(np.arange(len(wood.ring)), width)
    turn = (np.arange(len(at)) - start[at]) / np.maximum(width[at] - 1, 1)
    angle = 2 * np.pi * np.where(turn == 1, 0.0, turn)
    ring = wood.ring[at]
    tangent, side = stems.tangent[ring], stems.side[ring]
    outward = np.cos(angle)[:, None] * side + np.sin(angle)[:, None] * np.cross(tangent, side)
    outward = np.where(is_tip[at, None], 0.0, outward)
    radius = _stretched(wood) * np.repeat(girth_of(wood.whole) / girth_of(wood.corners), count)
    place = wood.centre[at] + radius[at, None] * outward
    normal = outward + np.where(is_tip[at], 1.0, stems.narrowing[ring])[:, None] * tangent
    around = skin.around[stems.stem[ring]]
    uv = np.column_stack([np.where(is_tip[at], 0.5, turn) * around, skin.v[ring]])
    return Mesh(
        place.astype(np.float32), _faces(wood, start), unit(normal), uv.astype(np.float32), skin.wind(ring),
        skin.shade[ring].astype(np.float32),
    )  # fmt: skip


def girth_of(corners: Ints) -> Floats:
    """Perimeter of a prism of radius 1, which is pi times its mean width seen from all sides."""
    return np.asarray(2 * corners * np.sin(np.pi / corners), dtype=np.float64)


def _stretched(wood: ThinWood) -> Floats:
    """Radius (r,) where the ring before the last of each stem is as much thicker as the last one is missed."""
    radius = wood.radius.copy()
    last = (wood.first[1:] - 1)[~wood.blunt]
    radius[last - 1] = np.minimum(radius[last - 1] + radius[last], 1.5 * radius[last - 1])
    return radius


def _faces(wood: ThinWood, start: Ints) -> NDArray[np.int32]:
    """Two triangles a side between rings, one a side to the tip, counter-clockwise from outside."""
    last, sharp = wood.first[1:] - 1, ~wood.blunt
    is_wall = np.ones(wood.first[-1], dtype=bool)
    is_wall[last] = False
    is_wall[last[sharp] - 1] = False
    sides = np.repeat(wood.corners, np.diff(wood.first))[is_wall]
    a = np.repeat(start[is_wall], sides) + _ranges(sides)
    b = a + np.repeat(sides + 1, sides)
    walls = np.stack([a, a + 1, b, a + 1, b + 1, b], axis=1).reshape(-1, 3)
    c = np.repeat(start[last[sharp] - 1], wood.corners[sharp]) + _ranges(wood.corners[sharp])
    points = np.stack([c, c + 1, np.repeat(start[last[sharp]], wood.corners[sharp])], axis=1)
    return np.concatenate([walls, points]).astype(np.int32)


def _ranges(count: Ints) -> Ints:
    """0, 1, ... (count[0] of them), then those of the next."""
    return np.asarray(np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count))
