"""Tubes: the branches of a plant as tapered tubes, in the plant's own frame (z up, metres)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from treefit.asset.mesh.hugging import hug
from treefit.asset.mesh.lobes import Lobes, lobes_of
from treefit.asset.mesh.mesh import Mesh, unit
from treefit.asset.mesh.skin import Skin, skin_of
from treefit.asset.mesh.stems import Stems, stems_of
from treefit.plant import Look, Plant
from treefit.plant.corners import corners_of, lobed_stems

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def branch_meshes(plant: Plant, sides: int = 8, plain: bool = False) -> dict[str, Mesh]:
    """Return the wood by name: 'trunk' (level 0) and 'branches' (all others); a name without stems is left out.

    Every stem is a closed tube of its own; `sides` is the count at the thickest one, thinner stems have fewer, a
    trunk with lobes has four a lobe. Stems run along curves and thick ones grow out of their parents, the trunk out of
    the ground; `plain` ones run straight from vertex to vertex and begin inside their parents.
    """
    return tubes_of(stems_of(plant, plain), plant.look, sides)


def tubes_of(stems: Stems, look: Look | None, sides: int) -> dict[str, Mesh]:
    """Return the wood along `stems` by name, as `branch_meshes` does."""
    if sides < 3:
        raise ValueError(f"mesh: sides must be 3 or more, got {sides}")
    if len(stems.level) == 0:
        return {}
    levels = {"trunk": stems.level == 0, "branches": stems.level > 0}
    lobed = lobed_stems(stems, look, sides)
    lobes, sides_of = lobes_of(stems, lobed), corners_of(stems.chains, lobed, sides)
    skin = skin_of(stems)
    return {name: _tubes(stems, skin, chosen, sides_of, lobes) for name, chosen in levels.items() if chosen.any()}


def _tubes(stems: Stems, skin: Skin, chosen: NDArray[np.bool_], sides_of: Ints, lobes: Lobes | None) -> Mesh:
    """Closed tubes of the `chosen` (s,) stems: rings with a doubled seam, a flat foot and a pointed tip.

    A foot with lobes is a fan around its centre: one around a corner would leave the hollows.
    """
    low, high, sides = stems.first[:-1][chosen], stems.first[1:][chosen], sides_of[chosen]
    ring = _ranges(low, high - low)
    ring_sides = sides_of[stems.stem[ring]]
    ring_start = np.concatenate([[0], np.cumsum(ring_sides + 1)])
    rim = _rim(stems, skin, ring, sides_of, ring_start[:-1], lobes)
    lobed = np.zeros(len(low), dtype=bool) if lobes is None else lobes.stem[chosen]
    tips, hubs = _tips(stems, skin, high - 1), _hubs(stems, low[lobed])
    first_ring = np.concatenate([[0], np.cumsum(high - low)[:-1]])
    last_ring = first_ring + (high - low) - 1
    is_last = np.zeros(len(ring), dtype=bool)
    is_last[last_ring] = True
    walls = _walls(ring_start[:-1][~is_last], ring_sides[~is_last])
    caps = _fans(ring_start[last_ring], sides, ring_start[-1] + np.arange(len(low)))
    feet = _feet(ring_start[first_ring][~lobed], sides[~lobed])
    hub = ring_start[-1] + len(low) + np.arange(lobed.sum())
    lobed_feet = _fans(ring_start[first_ring][lobed], sides[lobed], hub)[:, [1, 0, 2]]
    vertices, normals, uv = (np.concatenate(parts) for parts in zip(rim, tips, hubs, strict=True))
    faces = np.concatenate([walls, caps, feet, lobed_feet])
    at = np.concatenate([np.repeat(ring, ring_sides + 1), high - 1, low[lobed]])
    return Mesh(vertices.astype(np.float32), faces.astype(np.int32), unit(normals), uv.astype(np.float32),
                skin.wind(at), skin.shade[at].astype(np.float32))  # fmt: skip


Corners = tuple[Floats, Floats, Floats]  # place, normal, uv


def _rim(stems: Stems, skin: Skin, ring: Ints, sides_of: Ints, start: Ints, lobes: Lobes | None) -> Corners:
    """Corners of the rings, sides + 1 each: the last lies on the first with another u."""
    sides = sides_of[stems.stem[ring]]
    at = np.repeat(ring, sides + 1)
    turn = _ranges(np.zeros_like(sides), sides + 1) / np.repeat(sides, sides + 1)
    angle = 2 * np.pi * np.where(turn == 1, 0.0, turn)  # both ends of the seam get the same bytes
    tangent, side = stems.tangent[at], stems.side[at]
    outward = np.cos(angle)[:, None] * side + np.sin(angle)[:, None] * np.cross(tangent, side)
    radius, normal = stems.radius[at, None], outward + stems.narrowing[at, None] * tangent
    if lobes is not None:
        factor, against, loss = (share[:, None] for share in lobes.swell(at, angle))
        radius = radius * factor
        normal = normal - against * np.cross(tangent, outward) + loss * tangent
    place, ahead = stems.centre[at] + radius * outward, np.zeros(len(at))
    first_corner = np.full(len(stems.radius), -1)
    first_corner[ring] = start
    hug(stems, first_corner, sides_of, lobes, place, normal, ahead)
    around = skin.around[stems.stem[at]]
    along = skin.v[at] + ahead * around / (2 * np.pi * stems.radius[at])
    return place, normal, np.column_stack([turn * around, along])


def _tips(stems: Stems, skin: Skin, last: Ints) -> Corners:
    """One corner a stem, half a radius beyond its last ring."""
    reach = 0.5 * stems.radius[last]
    place = stems.centre[last] + reach[:, None] * stems.tangent[last]
    around = skin.around[stems.stem[last]]
    return place, stems.tangent[last], np.column_stack([around / 2, skin.v[last] + around / (4 * np.pi)])


def _hubs(stems: Stems, first: Ints) -> Corners:
    """One corner a stem in the middle of its first ring, seen from below."""
    return stems.centre[first], -stems.tangent[first], np.zeros((len(first), 2))


def _walls(start: Ints, sides: Ints) -> Ints:
    """Two triangles a side between each ring and the next one, which follows it in memory."""
    a = np.repeat(start, sides) + _ranges(np.zeros_like(sides), sides)
    b = a + np.repeat(sides + 1, sides)
    return np.stack([a, a + 1, b, a + 1, b + 1, b], axis=1).reshape(-1, 3)


def _fans(start: Ints, sides: Ints, apex: Ints) -> Ints:
    """One triangle a side from the last rings to the tips."""
    a = np.repeat(start, sides) + _ranges(np.zeros_like(sides), sides)
    return np.stack([a, a + 1, np.repeat(apex, sides)], axis=1)


def _feet(start: Ints, sides: Ints) -> Ints:
    """Triangles (sides - 2) that close each first ring, seen from below."""
    a = np.repeat(start, sides - 2)
    j = _ranges(np.ones_like(sides), sides - 2)
    return np.stack([a, a + j + 1, a + j], axis=1)


def _ranges(start: Ints, count: Ints) -> Ints:
    """start[0], start[0] + 1, ... (count[0] of them), then those of the next."""
    skipped = np.cumsum(count) - count
    steps: Ints = np.arange(count.sum()) - np.repeat(skipped - start, count)
    return steps
