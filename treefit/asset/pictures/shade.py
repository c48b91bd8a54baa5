"""Shading: the colour of every pixel that shows a triangle, from sun, sky and the ground's reflection."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.pictures.light import SUN, SunMap

Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Surface:
    """All triangles of a plant with what the light needs to know at their corners."""

    place: Floats  # (n, 3) m
    faces: NDArray[np.int32]  # (m, 3)
    normal: Floats  # (n, 3) unit
    colour: Floats  # (n, 3) linear
    sky: Floats  # (n,) share of the sky that is seen
    uv: Floats  # (n, 2) in bark cells, for the grain
    leaf: NDArray[np.bool_]  # (n,)


def shade(surface: Surface, screen: Floats, seen: NDArray[np.int32], sun: SunMap, bias: float, image: Floats) -> None:
    """Write linear colours into `image` (h, w, 3) wherever `seen` (h, w) names a triangle.

    `screen` (n, 3) is the projection that `seen` was filled with; a point is in shadow when the sun's map has
    something more than `bias` metres before it.
    """
    _shade(
        surface.faces, screen, surface.normal, surface.colour, surface.sky, surface.uv, surface.leaf,
        seen, sun.depth, sun.project(surface.place), np.float32(bias), SUN, image,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _hash(i, j):
    h = (np.uint32(i) * np.uint32(374761393) + np.uint32(j) * np.uint32(668265263)) & np.uint32(0xFFFFFFFF)
    h = ((h ^ (h >> np.uint32(13))) * np.uint32(1274126177)) & np.uint32(0xFFFFFFFF)
    return np.float32((h ^ (h >> np.uint32(16))) & np.uint32(0xFFFF)) / np.float32(65535)


@njit(cache=True, nogil=True)
def _grain(u, v):
    """Smooth noise in [0, 1]."""
    i, j = int(np.floor(u)), int(np.floor(v))
    s, t = u - i, v - j
    s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
    low = _hash(i, j) * (1 - s) + _hash(i + 1, j) * s
    high = _hash(i, j + 1) * (1 - s) + _hash(i + 1, j + 1) * s
    return low * (1 - t) + high * t


@njit(cache=True, nogil=True)
def _sunlit(depth, column, row, z):
    """Share of a 5 x 5 neighbourhood of the sun's map that lets light through to depth z."""
    size = depth.shape[0]
    c, r = int(column), int(row)
    lit = 0
    for dr in range(-2, 3):
        for dc in range(-2, 3):
            y, x = min(max(r + dr, 0), size - 1), min(max(c + dc, 0), size - 1)
            if depth[y, x] >= z:
                lit += 1
    return np.float32(lit) / np.float32(25)


@njit(cache=True, nogil=True, fastmath=True)
def _shade(faces, screen, normal, colour, sky, uv, leaf, seen, depth, in_sun, bias, sun, image):
    for r in range(seen.shape[0]):
        for c in range(seen.shape[1]):
            f = seen[r, c]
            if f < 0:
                continue
            i, j, k = faces[f, 0], faces[f, 1], faces[f, 2]
            x, y = np.float32(c + 0.5) - screen[i, 0], np.float32(r + 0.5) - screen[i, 1]
            bx, by = screen[j, 0] - screen[i, 0], screen[j, 1] - screen[i, 1]
            cx, cy = screen[k, 0] - screen[i, 0], screen[k, 1] - screen[i, 1]
            area = bx * cy - cx * by
            wj, wk = (x * cy - cx * y) / area, (bx * y - x * by) / area
            wi = 1 - wj - wk
            nx = wi * normal[i, 0] + wj * normal[j, 0] + wk * normal[k, 0]
            ny = wi * normal[i, 1] + wj * normal[j, 1] + wk * normal[k, 1]
            nz = wi * normal[i, 2] + wj * normal[j, 2] + wk * normal[k, 2]
            norm = np.sqrt(nx * nx + ny * ny + nz * nz) + np.float32(1e-6)
            nx, ny, nz = nx / norm, ny / norm, nz / norm
            facing = nx * sun[0] + ny * sun[1] + nz * sun[2]
            seen_sky = wi * sky[i] + wj * sky[j] + wk * sky[k]
            u = wi * in_sun[i, 0] + wj * in_sun[j, 0] + wk * in_sun[k, 0]
            v = wi * in_sun[i, 1] + wj * in_sun[j, 1] + wk * in_sun[k, 1]
            d = wi * in_sun[i, 2] + wj * in_sun[j, 2] + wk * in_sun[k, 2]
            lit = _sunlit(depth, u, v, d - bias)
            through = np.float32(0)
            grain = np.float32(1)
            if leaf[i]:
                direct = max((facing + np.float32(0.35)) / np.float32(1.35), np.float32(0))
                through = max(-facing, np.float32(0)) * np.float32(0.45)
            else:
                direct = max((facing + np.float32(0.15)) / np.float32(1.15), np.float32(0))
                gu = wi * uv[i, 0] + wj * uv[j, 0] + wk * uv[k, 0]
                gv = wi * uv[i, 1] + wj * uv[j, 1] + wk * uv[k, 1]
                grain = np.float32(0.62) + np.float32(0.5) * _grain(gu, gv) + np.float32(0.26) * _grain(3 * gu, 3 * gv)
            # light sources, linear: sun 2.1 x (1, .92, .76), sky (.50, .60, .74), ground (.20, .18, .13)
            up = np.float32(0.5) + np.float32(0.5) * nz
            for channel in range(3):
                base = wi * colour[i, channel] + wj * colour[j, channel] + wk * colour[k, channel]
                if channel == 0:
                    s, a, g, t = 2.1, 0.50, 0.20, 1.15
                elif channel == 1:
                    s, a, g, t = 1.93, 0.60, 0.18, 1.2
                else:
                    s, a, g, t = 1.60, 0.74, 0.13, 0.5
                light = (direct + through * t) * lit * s + (up * a + (1 - up) * g) * seen_sky
                image[r, c, channel] = base * grain * light
