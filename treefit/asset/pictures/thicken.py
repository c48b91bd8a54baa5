"""Thicken: stems made thick enough to be unbroken lines in a picture; and which triangles hang together."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.mesh import Mesh

Floats = NDArray[np.float32]


def thickened(mesh: Mesh, thinnest: float) -> Mesh:
    """Return tubes whose corners lie `thinnest` (m) or more from their axis, moved along their normals.

    A corner's distance from the axis is the least length of its edges over the turn of the normal along them: that
    of an edge around the tube, whatever the count of its sides; along the tube normals hardly turn.
    """
    radius = _radii(mesh.vertices, mesh.normals, mesh.faces)
    lack = np.maximum(np.float32(thinnest) - radius, 0)
    return replace(mesh, vertices=mesh.vertices + mesh.normals * lack[:, None]) if lack.any() else mesh


def pieces_of(faces: NDArray[np.int32]) -> NDArray[np.int32]:
    """Number the pieces of triangles (m, 3) that follow each other: one begins with corners beyond all before."""
    return _pieces(np.ascontiguousarray(faces))


@njit(cache=True, nogil=True)
def _radii(place, normal, faces):
    """Distance (n,) of each corner from the axis of its tube; infinite where normals do not turn."""
    least = np.full(place.shape[0], np.inf, dtype=np.float32)
    for f in range(faces.shape[0]):
        for side in range(3):
            i, j = faces[f, side], faces[f, (side + 1) % 3]
            length = turn = np.float32(0)
            for axis in range(3):
                length += (place[i, axis] - place[j, axis]) ** 2
                turn += (normal[i, axis] - normal[j, axis]) ** 2
            if turn > np.float32(0.01):
                radius = length / turn
                least[i], least[j] = min(least[i], radius), min(least[j], radius)
    return np.sqrt(least)


@njit(cache=True, nogil=True)
def _pieces(faces):
    piece = np.empty(faces.shape[0], dtype=np.int32)
    farthest, count = -1, -1
    for f in range(faces.shape[0]):
        low = min(faces[f, 0], faces[f, 1], faces[f, 2])
        if low > farthest:
            count += 1
        farthest = max(farthest, faces[f, 0], faces[f, 1], faces[f, 2])
        piece[f] = count
    return piece
