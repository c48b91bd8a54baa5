"""Mesh: triangles with what a renderer and an engine want to know at their corners; knows nothing of plants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Ints = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles whose corners run counter-clockwise seen from outside."""

    vertices: Floats  # (n, 3) m
    faces: Ints  # (m, 3)
    normals: Floats  # (n, 3) unit
    uv: Floats  # (n, 2); tubes: pictures of about a metre (bark_uv.py), leaves: the unit square, tip on top
    wind: Floats | None = None  # (n, 3) in [0, 1]: bend (0 at the root), phase, flutter; None: not known
    openness: Floats | None = None  # (n,) in [0, 1]: share of the sky that is seen, for ambient occlusion


def unit(vectors: NDArray[np.floating]) -> Floats:
    """Return `vectors` (n, 3) at length 1; those of no length stay as they are."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(vectors / np.maximum(length, 1e-12), dtype=np.float32)
