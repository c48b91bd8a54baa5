"""Planes: where a flat piece of foliage lies, and which way it is long."""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.external.mesh.vectors import cross, dot, row, square_to


@njit(cache=True, nogil=True)
def planes(places, triangles, normals, leaf, count):
    """Middle (k, 3), unit normal, long axis in the plane, and area (k,) of each leaf.

    The long axis is that of the second moments; of a piece as long as wide its shortest edge tells the direction.
    """
    middle, normal, area = np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count)
    for t in range(leaf.shape[0]):
        k, a, b, c = leaf[t], triangles[t, 0], triangles[t, 1], triangles[t, 2]
        nx, ny, nz = normals[t, 0], normals[t, 1], normals[t, 2]
        size = np.sqrt(nx * nx + ny * ny + nz * nz)
        turn = 1.0 if normal[k, 0] * nx + normal[k, 1] * ny + normal[k, 2] * nz >= 0 else -1.0
        area[k] += size
        for x in range(3):
            normal[k, x] += turn * normals[t, x]
            middle[k, x] += size * (places[a, x] + places[b, x] + places[c, x])
    for k in range(count):
        length = np.sqrt(normal[k, 0] ** 2 + normal[k, 1] ** 2 + normal[k, 2] ** 2)
        for x in range(3):
            middle[k, x] /= 3 * area[k]
            normal[k, x] /= length
    moment, edge, short = np.zeros((count, 6)), np.zeros((count, 3)), np.full(count, np.inf)
    corner = np.empty((4, 3))
    for t in range(leaf.shape[0]):
        k = leaf[t]
        size = np.sqrt(normals[t, 0] ** 2 + normals[t, 1] ** 2 + normals[t, 2] ** 2)
        for x in range(3):
            for c in range(3):
                corner[c, x] = places[triangles[t, c], x] - middle[k, x]
            corner[3, x] = corner[0, x] + corner[1, x] + corner[2, x]
        for c in range(4):  # moments of a triangle: those of its corners and of their sum, by 12
            x, y, z = corner[c, 0], corner[c, 1], corner[c, 2]
            moment[k, 0] += size * x * x
            moment[k, 1] += size * x * y
            moment[k, 2] += size * x * z
            moment[k, 3] += size * y * y
            moment[k, 4] += size * y * z
            moment[k, 5] += size * z * z
        for c in range(3):
            d = (c + 1) % 3
            x, y, z = corner[d, 0] - corner[c, 0], corner[d, 1] - corner[c, 1], corner[d, 2] - corner[c, 2]
            if x * x + y * y + z * z < short[k]:
                short[k], edge[k, 0], edge[k, 1], edge[k, 2] = x * x + y * y + z * z, x, y, z
    return middle, normal, _long_axes(moment, normal, edge), area


@njit(cache=True, nogil=True)
def _long_axes(moment, normal, edge):
    """Long axis (k, 3) in the plane of each leaf, from its second moments (k, 6)."""
    long = np.empty_like(normal)
    for k in range(normal.shape[0]):
        n, u = row(normal, k), row(edge, k)
        u = square_to(u, n)
        if dot(u, u) == 0.0:
            u = square_to((-n[1], n[0], 0.0) if abs(n[2]) < 0.9 else (0.0, -n[2], n[1]), n)
        v = cross(n, u)
        uu, uv, vv = _form(moment[k], u, u), _form(moment[k], u, v), _form(moment[k], v, v)
        turn = 0.0
        if np.sqrt((0.5 * (uu - vv)) ** 2 + uv * uv) > 0.1 * (uu + vv):
            turn = 0.5 * np.arctan2(2 * uv, uu - vv)
        cos, sin = np.cos(turn), np.sin(turn)
        for x in range(3):
            long[k, x] = cos * u[x] + sin * v[x]
    return long


@njit(inline="always")
def _form(m, a, b):
    return (
        a[0] * (m[0] * b[0] + m[1] * b[1] + m[2] * b[2])
        + a[1] * (m[1] * b[0] + m[3] * b[1] + m[4] * b[2])
        + a[2] * (m[2] * b[0] + m[4] * b[1] + m[5] * b[2])
    )
