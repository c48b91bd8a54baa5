"""Openness: how much of the sky each place of a plant sees past its leaves and twigs, and where out of it is."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.mesh.mesh import Mesh, unit
from treefit.plant import Plant

Floats = NDArray[np.float32]
Grid = NDArray[np.float64]

_CELLS = 26  # of the longest side of the plant
_MARGIN = 2  # empty cells around it
_EXTINCTION = 0.35  # loss of light per area of matter over that of its cell; under the physical 0.5: the inside is seen
_DARKEST = 0.12  # openness where no light comes in: shade is never black
_WAYS = ((2, -1, 0.5), (0, 1, 0.125), (0, -1, 0.125), (1, 1, 0.125), (1, -1, 0.125))
"""Axis, direction and share of the sky."""
_PUFFS = 3  # blurs of the density whose slope tells where out of the foliage is


@dataclass(frozen=True, eq=False)
class Crown:
    """Density of leaves and thin wood in cubes: their area over that of a side of the cube."""

    low: NDArray[np.float64]  # (3,) m
    cell: float  # m
    layer: Grid  # (nx, ny, nz)

    def sky_seen(self, place: Floats) -> Floats:
        """Share of the sky (n,) in (0, 1] that each point of `place` (n, 3) sees."""
        return self._sampled(self._light[..., None], place)[:, 0]

    def shaded(self, mesh: Mesh) -> Mesh:
        """Return `mesh` with its openness in this crown; the one that it has is what else hides its corners."""
        seen = self.sky_seen(mesh.vertices)
        return replace(mesh, openness=seen if mesh.openness is None else seen * mesh.openness)

    def outward(self, place: Floats) -> Floats:
        """Directions (n, 3) of length 0 to 1 in which there is less and less foliage around `place` (n, 3)."""
        slope = self._sampled(self._slope, place)
        length = np.linalg.norm(slope, axis=1, keepdims=True)
        return np.asarray(-slope / (length + max(float(length.mean()), 1e-9)), dtype=np.float32)

    @cached_property
    def _light(self) -> Grid:
        """Light that reaches each cell from above (half) and from the four sides."""
        layer, total = _blurred(self.layer), np.zeros_like(self.layer)
        for axis, direction, share in _WAYS:
            behind = np.cumsum(layer if direction > 0 else np.flip(layer, axis), axis)
            depth = behind if direction > 0 else np.flip(behind, axis)
            total += share * np.exp(-_EXTINCTION * np.maximum(depth - layer / 2, 0))
        return _DARKEST + (1 - _DARKEST) * total

    @cached_property
    def _slope(self) -> Grid:
        density = self.layer
        for _ in range(_PUFFS):
            density = _blurred(density)
        return np.stack([np.gradient(density, axis=axis) for axis in range(3)], axis=-1)

    def _sampled(self, grid: Grid, place: Floats) -> Floats:
        values: Floats = _trilinear(np.ascontiguousarray(grid), np.ascontiguousarray(place), self.low, 1 / self.cell)
        return values


def crown_of(plant: Plant) -> Crown:
    """Return the crown of `plant`; wood thicker than a third of a cube is not in it, for it would hide itself."""
    centres = plant.leaf_position + plant.leaf_axis * plant.leaf_size[:, :1] / 2
    area = np.pi / 4 * plant.leaf_size[:, 0] * plant.leaf_size[:, 1]
    end, start = plant.position[1:], plant.position[plant.parent[1:]]
    radius = np.maximum(plant.radius[1:], 0)
    everything = np.concatenate([centres, end])
    low = everything.min(axis=0).astype(np.float64)
    cell = max(float(np.ptp(everything, axis=0).max()) / _CELLS, 1e-6)
    thin = radius < cell / 3
    wood = 2 * radius * np.linalg.norm(end - start, axis=1)
    places = np.concatenate([centres, ((end + start) / 2)[thin]])
    index = np.maximum(((places - low) / cell).astype(np.int64) + _MARGIN, 0)
    shape = (np.ptp(everything, axis=0) / cell).astype(np.int64) + 2 * _MARGIN + 2
    flat = np.ravel_multi_index(tuple(np.minimum(index, shape - 1).T), tuple(shape))
    layer = np.bincount(flat, np.concatenate([area, wood[thin]]), int(shape.prod())).reshape(shape) / cell**2
    return Crown(low - (_MARGIN - 0.5) * cell, cell, layer)


def outward_of(crown: Crown, place: Floats) -> Floats:
    """Unit directions (n, 3) out of the crown at `place` (n, 3): of its ellipsoid and of the tuft around."""
    middle, spread = place.mean(axis=0), np.maximum(place.std(axis=0), 1e-6)
    return unit(unit((place - middle) / spread) + crown.outward(place))


def _blurred(layer: Grid) -> Grid:
    """Three-cell mean along every axis (the border is empty)."""
    for axis in range(3):
        layer = (np.roll(layer, 1, axis) + layer + np.roll(layer, -1, axis)) / 3
    return layer


@njit(cache=True, nogil=True)
def _trilinear(grid, place, low, per_metre):
    """Values (n, c) of `grid` (nx, ny, nz, c) at `place` (n, 3); `low` is the middle of its first cell."""
    n, c = place.shape[0], grid.shape[3]
    values = np.zeros((n, c), np.float32)
    cell, part = np.zeros(3, np.int64), np.zeros(3)
    for i in range(n):
        for axis in range(3):
            at = min(max((place[i, axis] - low[axis]) * per_metre, 0.0), grid.shape[axis] - 1.001)
            cell[axis] = int(at)
            part[axis] = at - cell[axis]
        for x in range(2):
            for y in range(2):
                for z in range(2):
                    weight = (
                        (part[0] if x else 1 - part[0]) * (part[1] if y else 1 - part[1])
                        * (part[2] if z else 1 - part[2])
                    )  # fmt: skip
                    for k in range(c):
                        values[i, k] += weight * grid[cell[0] + x, cell[1] + y, cell[2] + z, k]
    return values
