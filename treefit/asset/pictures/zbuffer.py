"""Z-buffer: which triangle is nearest at each pixel centre, holes seen through; knows nothing of plants or light.

The one rasteriser of whole models: pictures, the sun's shadow map, and whoever bakes a model into an image (an
impostor's colour, normal and alpha are looked up at the triangles that it returns).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.pictures.pyramids import Pyramids, channel_at, corners_of, is_there, level_for, pack

Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Holes:
    """Where triangles are not there: at pixels whose alpha is under the cutoff of their texture."""

    uv: Floats  # (n, 2)
    texture: NDArray[np.int32]  # (m,) of each triangle, an index into the pyramids
    alpha: Pyramids  # alpha is the last channel
    cutoff: Floats  # (textures,); -1 for one without holes


def nearest_triangles(
    screen: Floats, faces: NDArray[np.int32], height: int, width: int, holes: Holes | None = None
) -> tuple[NDArray[np.int32], Floats]:
    """Return the triangle (height, width) seen at each pixel, -1 for none, and its depth.

    `screen` (n, 3) holds column, row and depth; pixel (r, c) has its centre at (c + 0.5, r + 0.5), small depth is near.
    """
    seen = np.full((height, width), -1, dtype=np.int32)
    depth = np.full((height, width), np.inf, dtype=np.float32)
    if holes is None:
        holes = Holes(_NO_UV, np.zeros(len(faces), np.int32), _SOLID, np.full(1, -1, np.float32))
    _fill(
        np.ascontiguousarray(screen, dtype=np.float32), np.ascontiguousarray(faces),
        np.ascontiguousarray(holes.uv), holes.texture, holes.alpha.arrays, holes.cutoff, seen, depth,
    )  # fmt: skip
    return seen, depth


_NO_UV = np.zeros((0, 2), dtype=np.float32)
_SOLID = pack([[np.ones((1, 1, 4), dtype=np.float32)]])


@njit(cache=True, nogil=True)
def _fill(screen, faces, uv, texture, alpha, cutoff, seen, depth):
    height, width = seen.shape
    half, one = np.float32(0.5), np.float32(1)
    texels = alpha[0]
    for f in range(faces.shape[0]):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        ax, ay, az = screen[a, 0], screen[a, 1], screen[a, 2]
        bx, by, cx, cy = screen[b, 0] - ax, screen[b, 1] - ay, screen[c, 0] - ax, screen[c, 1] - ay
        left = max(int(np.ceil(ax + min(np.float32(0), bx, cx) - half)), 0)
        right = min(int(np.floor(ax + max(np.float32(0), bx, cx) - half)), width - 1)
        top = max(int(np.ceil(ay + min(np.float32(0), by, cy) - half)), 0)
        bottom = min(int(np.floor(ay + max(np.float32(0), by, cy) - half)), height - 1)
        area = bx * cy - cx * by
        if area == 0 or left > right or top > bottom:
            continue
        inverse = one / area
        bz, cz = screen[b, 2] - az, screen[c, 2] - az
        which = texture[f]
        limit = cutoff[which]
        level = 0
        u, v = np.float32(0), np.float32(0)
        bu, bv, cu, cv = u, u, u, u
        if limit >= 0:
            u, v = uv[a, 0], uv[a, 1]
            bu, bv, cu, cv = uv[b, 0] - u, uv[b, 1] - v, uv[c, 0] - u, uv[c, 1] - v
            level = level_for(alpha, which, abs(bu * cv - cu * bv), abs(area))
        for r in range(top, bottom + 1):
            y = np.float32(r) + half - ay
            for col in range(left, right + 1):
                x = np.float32(col) + half - ax
                w1 = (x * cy - cx * y) * inverse
                w2 = (bx * y - x * by) * inverse
                if w1 < 0 or w2 < 0 or w1 + w2 > one:
                    continue
                z = az + w1 * bz + w2 * cz
                if z >= depth[r, col]:
                    continue
                if limit >= 0:
                    i, j, k, m, s, t = corners_of(alpha, which, level, u + w1 * bu + w2 * cu, v + w1 * bv + w2 * cv)
                    there = channel_at(texels, 3, i, j, k, m, s, t)
                    if not is_there(there, limit, level, r, col, f):
                        continue
                depth[r, col] = z
                seen[r, col] = f
