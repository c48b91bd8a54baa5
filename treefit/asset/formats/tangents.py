"""Tangents: where the texture's right side points at each corner, as normal maps in glTF 2.0 need it."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.mesh import Mesh


def tangents(mesh: Mesh) -> NDArray[np.float32]:
    """Return x, y, z of the unit tangent and the sign of the bitangent (n, 4), glTF 2.0 sec. 3.7.2.1.

    The tangent is the mean of that of the triangles at a corner, at right angles to its normal; the bitangent is
    normal x tangent times the sign, and points to the top of the texture.
    """
    right, up = _directions(mesh.vertices, mesh.faces, mesh.uv)
    found: NDArray[np.float32] = _straightened(right, up, mesh.normals)
    return found


@njit(cache=True, nogil=True)
def _directions(vertices, faces, uv):
    """Sums (n, 3) of the unit vectors in which u and v grow, over the triangles at each corner."""
    right = np.zeros((len(vertices), 3), np.float32)
    up = np.zeros((len(vertices), 3), np.float32)
    grow = np.empty((2, 3), np.float32)
    for a, b, c in faces:
        u1, v1 = uv[b, 0] - uv[a, 0], uv[b, 1] - uv[a, 1]
        u2, v2 = uv[c, 0] - uv[a, 0], uv[c, 1] - uv[a, 1]
        side = np.sign(u1 * v2 - u2 * v1)
        for axis in range(3):
            one, two = vertices[b, axis] - vertices[a, axis], vertices[c, axis] - vertices[a, axis]
            grow[0, axis] = side * (v2 * one - v1 * two)
            grow[1, axis] = side * (u1 * two - u2 * one)
        for which, sums in ((0, right), (1, up)):
            length = np.sqrt(grow[which, 0] ** 2 + grow[which, 1] ** 2 + grow[which, 2] ** 2)
            if length > 1e-20:
                for axis in range(3):
                    share = grow[which, axis] / length
                    sums[a, axis] += share
                    sums[b, axis] += share
                    sums[c, axis] += share
    return right, up


@njit(cache=True, nogil=True)
def _straightened(right, up, normals):
    """Unit vectors near `right` at right angles to `normals`, and the sign that turns the bitangent `up` (n, 4)."""
    made = np.empty((len(right), 4), np.float32)
    for i in range(len(right)):
        nx, ny, nz = normals[i]
        x, y, z = right[i]
        along = nx * x + ny * y + nz * z
        x, y, z = x - along * nx, y - along * ny, z - along * nz
        length = np.sqrt(x * x + y * y + z * z)
        if length < 1e-6:  # the texture has no direction there: any that is at right angles
            if abs(nx) < 0.7:
                x, y, z = np.float32(0), nz, -ny
            else:
                x, y, z = -nz, np.float32(0), nx
            length = np.sqrt(x * x + y * y + z * z)
        x, y, z = x / length, y / length, z / length
        top = (ny * z - nz * y) * up[i, 0] + (nz * x - nx * z) * up[i, 1] + (nx * y - ny * x) * up[i, 2]
        made[i, 0], made[i, 1], made[i, 2] = x, y, z
        made[i, 3] = -1 if top < 0 else 1
    return made
