"""Shading: the colour of every sample that shows a triangle, from sun, sky and the ground's reflection."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.material.colour import to_srgb
from treefit.asset.pictures.light import SUN, SunMap
from treefit.asset.pictures.pyramids import channel_at, corners_of, level_for
from treefit.asset.pictures.scene import Scene

Floats = NDArray[np.float32]

# Linear light: of the sun, of the sky above, of the ground below, and what of the sun comes through a leaf.
_LIGHT = np.array([[2.15, 1.97, 1.60], [0.50, 0.57, 0.66], [0.21, 0.19, 0.13], [1.15, 1.20, 0.50]], dtype=np.float32)
_HALF_WAY = (SUN - [0, 1, 0]) / np.linalg.norm(SUN - [0, 1, 0])  # between the sun and the viewer, who looks along +y
_STEPS = 2048
_SRGB = to_srgb(np.linspace(0, 1, _STEPS + 1, dtype=np.float32))


def shade(scene: Scene, screen: Floats, seen: NDArray[np.int32], left: Floats, sun: SunMap, image: Floats) -> None:
    """Blend the samples that `seen` (k * h, k * w) names into `image` (h, w, 3) sRGB in [0, 1], its backdrop.

    `screen` (n, 3) is the projection that `seen` was filled with, `left` (h, w) the share of light in creases.
    """
    bias = np.float32(0.008 * scene.tall)  # what is less far behind what the sun sees is lit
    made = scene.surfaces
    turn, shift = sun.turn, sun.shift - np.array([0, 0, bias], dtype=np.float32)
    _shade(
        scene.faces, screen, scene.place, scene.normal, scene.uv, scene.sky, scene.texture, scene.piece,
        made.colour.arrays, made.bump.arrays, made.tone, made.thin, seen, left, sun.depth, turn, shift,
        SUN, _HALF_WAY.astype(np.float32), _LIGHT, _SRGB, image,
    )  # fmt: skip


@njit(cache=True, nogil=True, fastmath=True, error_model="numpy")
def _shade(
    faces, screen, place, normal, uv, sky, texture, piece, colour, bump, tone, thin,
    seen, left, depth, turn, shift, sun, half_way, light, srgb, image,
):  # fmt: skip
    k = seen.shape[0] // image.shape[0]
    part, one = np.float32(1) / np.float32(k * k), np.float32(1)
    steps = np.float32(len(srgb) - 1)
    tint, across, flat = np.ones(3, np.float32), np.empty((2, 3), np.float32), np.empty(3, np.float32)
    n, p, at_sun, shown = np.empty(3, np.float32), np.empty(3, np.float32), np.empty(3, np.float32), np.empty(3)
    last, ground, scattered = -1, np.float32(1e-3), np.float32(0.14)  # light that leaves hand on to each other
    for row in range(image.shape[0]):
        for column in range(image.shape[1]):
            count = 0
            shown[:] = 0
            for sample in range(k * k):
                r, c = row * k + sample // k, column * k + sample % k
                f = seen[r, c]
                if f < 0:
                    continue
                i, j, m = faces[f, 0], faces[f, 1], faces[f, 2]
                bx, by = screen[j, 0] - screen[i, 0], screen[j, 1] - screen[i, 1]
                cx, cy = screen[m, 0] - screen[i, 0], screen[m, 1] - screen[i, 1]
                bu, bv, cu, cv = uv[j, 0] - uv[i, 0], uv[j, 1] - uv[i, 1], uv[m, 0] - uv[i, 0], uv[m, 1] - uv[i, 1]
                area, uv_area, which = bx * cy - cx * by, bu * cv - cu * bv, texture[f]
                leaf = thin[which]
                if f != last:
                    last = f
                    _directions(place[i], place[j], place[m], bu, bv, cu, cv, across, flat)
                    _tint(piece[f], leaf, tone[which], tint)
                x, y = np.float32(c + 0.5) - screen[i, 0], np.float32(r + 0.5) - screen[i, 1]
                wj, wm = (x * cy - cx * y) / area, (bx * y - x * by) / area
                wi, u, v = one - wj - wm, uv[i, 0] + wj * bu + wm * cu, uv[i, 1] + wj * bv + wm * cv
                for a in range(3):
                    n[a] = wi * normal[i, a] + wj * normal[j, a] + wm * normal[m, a]
                    p[a] = wi * place[i, a] + wj * place[j, a] + wm * place[m, a]
                if p[2] < -ground:  # a foot reaches into the ground
                    continue
                count += 1
                rough = _bend(n, flat, across, leaf, bump, which, abs(uv_area), abs(area), u, v)
                for a in range(3):
                    at_sun[a] = turn[a, 0] * p[0] + turn[a, 1] * p[1] + turn[a, 2] * p[2] + shift[a]
                lit = _sunlit(depth, at_sun, sample & 3)
                direct, through, gloss = _sunlight(n, sun, half_way, leaf, rough * tone[which, 3])
                up = np.float32(0.5) + np.float32(0.5) * n[2]
                open_sky = scattered + (one - scattered) * (wi * sky[i] + wj * sky[j] + wm * sky[m])
                level = level_for(colour, which, abs(uv_area), abs(area))
                e, g, h, o, s, t = corners_of(colour, which, level, u, v)
                for a in range(3):
                    falls = (direct + through * light[3, a]) * lit * light[0, a]
                    falls += (up * light[1, a] + (one - up) * light[2, a]) * open_sky
                    value = channel_at(colour[0], a, e, g, h, o, s, t) * tint[a] * falls + gloss * lit * light[0, a]
                    value *= left[row, column]
                    value *= (one + value / np.float32(1.6)) / (one + value)  # what is brightest is rolled off
                    shown[a] += srgb[int(min(value, one) * steps + np.float32(0.5))] * part
            rest = one - np.float32(count) * part
            for a in range(3):
                image[row, column, a] = image[row, column, a] * rest + shown[a]


@njit(inline="always")
def _unit(vector):
    length = np.sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2])
    scale = np.float32(1) / max(length, np.float32(1e-12))
    for a in range(3):
        vector[a] *= scale


@njit(cache=True, nogil=True, fastmath=True, error_model="numpy")
def _directions(a, b, c, bu, bv, cu, cv, across, flat):
    """Fill `across` (2, 3), the directions in which u and v grow, and `flat` (3,), the normal of the seen side."""
    sign = np.sign(bu * cv - cu * bv)
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        flat[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j])
        across[0, i] = sign * (cv * (b[i] - a[i]) - bv * (c[i] - a[i]))
        across[1, i] = sign * (bu * (c[i] - a[i]) - cu * (b[i] - a[i]))
    _unit(flat)
    _unit(across[0])
    _unit(across[1])
    if flat[1] > 0:
        for i in range(3):
            flat[i] = -flat[i]


@njit(inline="always")
def _bend(n, flat, across, leaf, bump, which, uv_area, area, u, v):
    """Turn the normal `n` to the side that is seen and by the normal map, make it unit; return the roughness."""
    if leaf:  # bent as the crown is, and as the leaf itself
        for a in range(3):
            n[a] += np.float32(0.6) * flat[a]
    _unit(n)
    i, j, k, m, s, t = corners_of(bump, which, level_for(bump, which, uv_area, area), u, v)
    x, y = channel_at(bump[0], 0, i, j, k, m, s, t), channel_at(bump[0], 1, i, j, k, m, s, t)
    for a in range(3):
        n[a] += x * across[0, a] + y * across[1, a]
    _unit(n)
    return channel_at(bump[0], 3, i, j, k, m, s, t)


@njit(inline="always")
def _sunlit(depth, at, turn):
    """Share of a 5 x 5 neighbourhood of the sun's map that lets light through to `at` (column, row, depth).

    Each of four samples of a pixel, `turn` 0 to 3, asks a quarter of it.
    """
    size = depth.shape[0]
    c, r = int(at[0]) - 2, int(at[1]) - 2
    lit = asked = 0
    for k in range(turn, 25, 4):
        y, x = min(max(r + k // 5, 0), size - 1), min(max(c + k % 5, 0), size - 1)
        asked += 1
        if depth[y, x] >= at[2]:
            lit += 1
    return np.float32(lit) / np.float32(asked)


@njit(inline="always")
def _sunlight(n, sun, half_way, leaf, rough):
    """Shares of the sun that a surface scatters, lets through and mirrors (Blinn-Phong, 1.2 % at right angles)."""
    none, one = np.float32(0), np.float32(1)
    facing = n[0] * sun[0] + n[1] * sun[1] + n[2] * sun[2]
    wrap = np.float32(0.35) if leaf else np.float32(0.15)
    direct = max((facing + wrap) / (one + wrap), none)
    through = max(-facing, none) * np.float32(0.45) if leaf else none
    alpha = max(rough * rough, np.float32(0.03))
    power = np.float32(2) / (alpha * alpha) - np.float32(2)
    mirrored = max(n[0] * half_way[0] + n[1] * half_way[1] + n[2] * half_way[2], none) ** power
    return direct, through, np.float32(0.0015) * (power + np.float32(8)) * mirrored * max(facing, none)


@njit(inline="always")
def _tint(piece, leaf, tone, tint):
    """Fill `tint` (3,) with the material's colour; every leaf is a little lighter or darker, warmer or cooler."""
    tint[:] = tone[:3]
    if leaf:
        warm, bright = _chance(piece, 1) - np.float32(0.5), _chance(piece, 2) - np.float32(0.5)
        tint[:] *= np.float32(1) + np.float32(0.34) * bright
        tint[0] *= np.float32(1) + np.float32(0.30) * warm
        tint[2] *= np.float32(1) - np.float32(0.30) * warm


@njit(inline="always")
def _chance(index, stream):
    """Number in [0, 1] that depends on its arguments alone."""
    h = (np.uint32(index) * np.uint32(374761393) + np.uint32(stream) * np.uint32(668265263)) & np.uint32(0xFFFFFFFF)
    h = ((h ^ (h >> np.uint32(13))) * np.uint32(1274126177)) & np.uint32(0xFFFFFFFF)
    return np.float32((h ^ (h >> np.uint32(16))) & np.uint32(0xFFFF)) / np.float32(65535)
