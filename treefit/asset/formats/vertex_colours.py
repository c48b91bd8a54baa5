"""Vertex colours: what a mesh knows at its corners besides shape, in four bytes a corner as files carry it.

The two sets, in the order that `AssetSettings.vertex_colours` asks for:

- occlusion: red = green = blue = how much light comes in, alpha = 1. Viewers multiply the surface by it (glTF 2.0,
  sec. 3.9.2), and cast shadows of their own, so it is DARKEST + (1 - DARKEST) * sqrt(openness): foliage that sees a
  seventh of the sky is lit by its neighbours too, and a tree keeps about its colour.
- wind, read by vegetation shaders (GPU Gems 3, chapter 16): red = bend, 0 where the trunk leaves the ground and 1 at
  the farthest tips; green = phase, what moves together has the same; blue = flutter, 0 on wood and 1 at the tips of
  leaves; alpha = openness as it is. As first set it tints what a plain viewer shows.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from treefit.asset.mesh import Mesh

DARKEST = 0.5
"""Light where nothing of the sky is seen."""

Bytes = NDArray[np.uint8]


def vertex_colours(mesh: Mesh, first: Literal["occlusion", "wind"]) -> tuple[Bytes, ...]:
    """Return the sets (n, 4) of `mesh` with `first` before the other; none when the mesh knows neither."""
    if mesh.wind is None and mesh.openness is None:
        return ()
    n = len(mesh.vertices)
    openness = np.ones(n, np.float32) if mesh.openness is None else mesh.openness
    wind = np.zeros((n, 3), np.float32) if mesh.wind is None else mesh.wind
    light = DARKEST + (1 - DARKEST) * np.sqrt(np.clip(openness, 0, 1))
    occlusion = _bytes(np.column_stack([light, light, light, np.ones(n, np.float32)]))
    moved = _bytes(np.column_stack([wind, openness]))
    return (occlusion, moved) if first == "occlusion" else (moved, occlusion)


def _bytes(shares: NDArray[np.float32]) -> Bytes:
    return np.asarray(np.rint(np.clip(shares, 0, 1) * 255), dtype=np.uint8)
