"""Baking: what a camera sees of a model, as textures: albedo, normals and how much of each texel is covered."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt, gaussian_filter

from treefit.asset.formats.vertex_colours import DARKEST
from treefit.asset.lod.view import View
from treefit.asset.pictures.pyramids import channel_at, corners_of, level_for
from treefit.asset.pictures.scene import Scene
from treefit.asset.pictures.zbuffer import nearest_triangles

Floats = NDArray[np.float32]
FINER = 3  # samples a texel along each side
_BLOCK = 16  # texels along each side in which coverage is kept
_AROUND = 0.018  # of the height: the neighbourhood whose mean depth is compared
_DEEP = 0.22  # loss of light a neighbourhood of depth
_OWN_SHADE = 0.93  # a crown lit by the sun is in its own shade so far
_DULLEST = 0.15  # of a normal towards the camera: cards are lit from before


@dataclass(frozen=True, eq=False)
class Baked:
    """What is seen, row 0 on top."""

    colour: Floats  # (h, w, 3) linear, where nothing is seen that of what is next to it
    normal: Floats  # (h, w, 3) unit: right, up, towards the camera
    share: Floats  # (h, w) of each texel that is covered


def bake(scene: Scene, view: View) -> Baked:
    """Return what `view`, whose rows and columns are FINER times those of the texture, sees of `scene`.

    Colour is that of the materials times the light that vertex colours of files have, without sun; what lies behind
    its surroundings is darker, for cards cast no shade on themselves as a crown does.
    """
    screen = view.project(scene.place)
    seen, depth = nearest_triangles(screen, scene.faces, view.rows, view.columns, scene.holes)
    h, w = view.rows // FINER, view.columns // FINER
    out = np.zeros((h, w, 8), dtype=np.float32)
    light = (DARKEST + (1 - DARKEST) * scene.sky).astype(np.float32)
    turn = (view.turn / np.float32(view.scale)) * np.array([[1], [-1], [-1]], dtype=np.float32)
    _sum(
        seen, depth, scene.faces, screen, scene.normal, scene.uv, light, scene.texture,
        scene.surfaces.colour.arrays, scene.surfaces.tone, turn, out,
    )  # fmt: skip
    share = out[..., 6] / np.float32(FINER * FINER)
    mean = out[..., :6] / np.maximum(out[..., 6:7], 1)
    deep = np.asarray(out[..., 7] / (np.maximum(out[..., 6], 1) * view.scale), dtype=np.float32)
    mean[..., :3] *= _relief(share, deep, view.rows / view.scale)[..., None]
    if (share > 0).any() and (share == 0).any():
        mean = mean[tuple(distance_transform_edt(share == 0, return_distances=False, return_indices=True))]
    length = np.maximum(np.linalg.norm(mean[..., 3:], axis=2, keepdims=True), 1e-6)
    return Baked(
        np.asarray(mean[..., :3], dtype=np.float32), np.asarray(mean[..., 3:] / length, dtype=np.float32), share
    )


def _relief(share: Floats, depth: Floats, tall: float) -> Floats:
    """Light (h, w) by how far the `depth` (h, w) in m is before the mean of what is around it."""
    reach = _AROUND * share.shape[0]
    mean = gaussian_filter(depth * share, reach) / np.maximum(gaussian_filter(share, reach), 1e-6)
    light = _OWN_SHADE - _DEEP * (depth - mean) / (_AROUND * tall)
    return np.asarray(np.clip(light, 0.35, 1.15), dtype=np.float32)


def cut_out(share: Floats, cutoff: float) -> Floats:
    """Return alpha (h, w) in [0, 1] that reaches `cutoff` on as much of every block as `share` covers of it.

    Else twigs thinner than a texel would vanish and gaps fill (Castano 2010, Computing alpha mipmaps).
    """
    h, w = share.shape
    alpha = share.copy()
    for top in range(0, h, _BLOCK):
        for left in range(0, w, _BLOCK):
            block = share[top : top + _BLOCK, left : left + _BLOCK]
            count = round(float(block.sum()))
            limit = float(np.partition(block.ravel(), block.size - count)[block.size - count]) if count else 1.0
            limit = max(limit, 1e-3)
            over = cutoff + (1 - cutoff) * (block - limit) / max(1 - limit, 1e-3)
            lifted = np.where(block >= limit, np.where(block >= 1, 1, over), block * (cutoff / limit) * 0.96)
            alpha[top : top + _BLOCK, left : left + _BLOCK] = lifted if count else np.minimum(block, cutoff / 2)
    return alpha


@njit(cache=True, nogil=True, error_model="numpy")
def _sum(seen, depth, faces, screen, normal, uv, light, texture, colour, tone, turn, out):
    """Add colour, normal and count of the samples of every texel and depth to `out` (h, w, 8)."""
    one = np.float32(1)
    n = np.empty(3, np.float32)
    for r in range(out.shape[0] * FINER):
        for c in range(out.shape[1] * FINER):
            f = seen[r, c]
            if f < 0:
                continue
            i, j, m = faces[f, 0], faces[f, 1], faces[f, 2]
            bx, by = screen[j, 0] - screen[i, 0], screen[j, 1] - screen[i, 1]
            cx, cy = screen[m, 0] - screen[i, 0], screen[m, 1] - screen[i, 1]
            area = bx * cy - cx * by
            x, y = np.float32(c + 0.5) - screen[i, 0], np.float32(r + 0.5) - screen[i, 1]
            wj, wm = (x * cy - cx * y) / area, (bx * y - x * by) / area
            wi = one - wj - wm
            bu, bv, cu, cv = uv[j, 0] - uv[i, 0], uv[j, 1] - uv[i, 1], uv[m, 0] - uv[i, 0], uv[m, 1] - uv[i, 1]
            which = texture[f]
            level = level_for(colour, which, abs(bu * cv - cu * bv), abs(area))
            a, b, d, e, s, t = corners_of(
                colour, which, level, uv[i, 0] + wj * bu + wm * cu, uv[i, 1] + wj * bv + wm * cv
            )
            bright = wi * light[i] + wj * light[j] + wm * light[m]
            texel = out[r // FINER, c // FINER]
            for channel in range(3):
                texel[channel] += channel_at(colour[0], channel, a, b, d, e, s, t) * tone[which, channel] * bright
                n[channel] = np.float32(0)
                for axis in range(3):
                    bent = wi * normal[i, axis] + wj * normal[j, axis] + wm * normal[m, axis]
                    n[channel] += turn[channel, axis] * bent
            n[2] = max(abs(n[2]), np.float32(_DULLEST))
            for channel in range(3):
                texel[3 + channel] += n[channel]
            texel[6] += one
            texel[7] += depth[r, c]
