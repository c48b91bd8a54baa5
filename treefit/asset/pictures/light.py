"""Light: where the sun stands, and where its rays are blocked."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.asset.pictures.scene import Scene
from treefit.asset.pictures.zbuffer import nearest_triangles

Floats = NDArray[np.float32]

SUN = np.array([-0.38, -0.50, 0.78], dtype=np.float32)  # towards the sun: left, before the plant, high
SUN /= np.linalg.norm(SUN)
_MAP, _LARGEST = 1.25, 1280  # pixels of the sun's view, by the height of the picture


@dataclass(frozen=True, eq=False)
class SunMap:
    """Depth along the sun's rays of what it sees first."""

    depth: Floats  # (m, m), infinite where the ray meets nothing
    turn: Floats  # (3, 3): rows are column, row and depth directions, per metre
    shift: Floats  # (3,)

    def project(self, place: Floats) -> Floats:
        """Column, row, depth (n, 3) in the map of `place` (n, 3)."""
        return np.asarray(np.einsum("ni,ji->nj", place, self.turn) + self.shift, dtype=np.float32)


def sun_map(scene: Scene, height: int) -> SunMap:
    """Return the sun's view of a scene, fine enough for a picture of `height` pixels."""
    size = min(max(round(_MAP * height), 64), _LARGEST)
    right = np.cross([0.0, 0.0, 1.0], SUN)
    right /= np.linalg.norm(right)
    turn = np.stack([right, np.cross(SUN, right), -SUN]).astype(np.float32)
    seen = np.einsum("ni,ji->nj", scene.place, turn)  # a tenth of the time of `@` with three columns
    low, high = seen.min(axis=0), seen.max(axis=0)
    scale = (size - 8) / max(float((high - low)[:2].max()), 1e-6)
    stretch = np.array([scale, scale, 1], dtype=np.float32)
    shift = np.array([4 - scale * low[0], 4 - scale * low[1], 0], dtype=np.float32)
    _, depth = nearest_triangles(seen * stretch + shift, scene.faces, size, size, scene.holes)
    return SunMap(depth, turn * stretch[:, None], shift)
