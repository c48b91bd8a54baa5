"""Z-buffer: which triangle is nearest at each pixel centre; knows nothing of plants or light."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray


def nearest_triangles(
    screen: NDArray[np.float32], faces: NDArray[np.int32], height: int, width: int
) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
    """Return the triangle (height, width) seen at each pixel, -1 for none, and its depth.

    `screen` (n, 3) holds column, row and depth; pixel (r, c) has its centre at (c + 0.5, r + 0.5), small depth is near.
    """
    seen = np.full((height, width), -1, dtype=np.int32)
    depth = np.full((height, width), np.inf, dtype=np.float32)
    _fill(np.ascontiguousarray(screen, dtype=np.float32), np.ascontiguousarray(faces), seen, depth)
    return seen, depth


@njit(cache=True, nogil=True)
def _fill(screen, faces, seen, depth):
    height, width = seen.shape
    half = np.float32(0.5)
    for f in range(faces.shape[0]):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        ax, ay, az = screen[a, 0], screen[a, 1], screen[a, 2]
        bx, by, bz = screen[b, 0], screen[b, 1], screen[b, 2]
        cx, cy, cz = screen[c, 0], screen[c, 1], screen[c, 2]
        area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
        if area == 0:
            continue
        left = max(int(np.floor(min(ax, bx, cx) - half)), 0)
        right = min(int(np.ceil(max(ax, bx, cx) - half)), width - 1)
        top = max(int(np.floor(min(ay, by, cy) - half)), 0)
        bottom = min(int(np.ceil(max(ay, by, cy) - half)), height - 1)
        for r in range(top, bottom + 1):
            y = np.float32(r) + half
            for col in range(left, right + 1):
                x = np.float32(col) + half
                w1 = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / area
                w2 = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / area
                if w1 < 0 or w2 < 0 or w1 + w2 > 1:
                    continue
                z = az + w1 * (bz - az) + w2 * (cz - az)
                if z < depth[r, col]:
                    depth[r, col] = z
                    seen[r, col] = f
