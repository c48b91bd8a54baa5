"""Pyramids: textures at full size, at half of it and so on, as kernels read them; knows nothing of materials."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float32]

_LEAST = 4  # texels along the shorter side of the coarsest level


@dataclass(frozen=True, eq=False)
class Pyramids:
    """Levels of several textures one after the other, the finest of each first; a texture repeats once a unit of uv."""

    texels: Floats  # (t, 4)
    first: NDArray[np.int64]  # (textures, levels): where in `texels` a level begins
    rows: NDArray[np.int64]  # (textures, levels)
    columns: NDArray[np.int64]  # (textures, levels)
    count: NDArray[np.int64]  # (textures,) levels

    @property
    def arrays(self) -> tuple[Floats, NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
        """The fields in order, as kernels take them."""
        return self.texels, self.first, self.rows, self.columns, self.count


def pyramid(image: Floats, cutoff: float | None = None) -> list[Floats]:
    """Return `image` (h, w, 4) and its halves, each the mean of 2 x 2 texels of the one before.

    With `cutoff` the last channel of the halves is the share of their texels that is there, and what is not there
    has no say in their colour: `is_there` makes holes of it that are as large at any distance.
    """
    levels = [np.ascontiguousarray(image, dtype=np.float32)]
    mean = levels[0]
    if cutoff is not None:
        there = (mean[..., 3:] >= cutoff).astype(np.float32)
        mean = np.concatenate([mean[..., :3] * there, there], axis=2)
    while min(mean.shape[:2]) >= 2 * _LEAST:
        h, w = mean.shape[0] // 2 * 2, mean.shape[1] // 2 * 2
        mean = np.add.reduce([mean[i:h:2, j:w:2] for i in (0, 1) for j in (0, 1)]) * np.float32(0.25)
        levels.append(mean if cutoff is None else _unweighted(mean))
    return levels


def _unweighted(mean: Floats) -> Floats:
    """Return colours that were weighted by the last channel without that weight."""
    weight = np.maximum(mean[..., 3:], np.float32(1e-6))
    return np.concatenate([mean[..., :3] / weight, mean[..., 3:]], axis=2)


def pack(textures: Sequence[Sequence[Floats]]) -> Pyramids:
    """Return the pyramids of `textures`, each the list of its levels (h, w, 4)."""
    most = max(len(levels) for levels in textures)
    first, rows, columns = (np.zeros((len(textures), most), dtype=np.int64) for _ in range(3))
    begin = 0
    for i, levels in enumerate(textures):
        for j, level in enumerate(levels):
            first[i, j], rows[i, j], columns[i, j] = begin, *level.shape[:2]
            begin += rows[i, j] * columns[i, j]
    texels = np.concatenate([level.reshape(-1, 4) for levels in textures for level in levels])
    return Pyramids(texels, first, rows, columns, np.array([len(levels) for levels in textures], dtype=np.int64))


@njit(inline="always")
def level_for(pyramids, texture, uv_area, screen_area):
    """Level whose texels are about as large as a pixel of a triangle with these areas in uv and on the screen."""
    _, _, rows, columns, count = pyramids
    texels_a_pixel = np.float32(rows[texture, 0] * columns[texture, 0]) * uv_area / max(screen_area, np.float32(1e-9))
    level = 0
    while level + 1 < count[texture] and texels_a_pixel > np.float32(2.8):  # finer than the mean of two levels
        texels_a_pixel *= np.float32(0.25)
        level += 1
    return level


@njit(inline="always")
def corners_of(pyramids, texture, level, u, v):
    """Four texels around (u, v), v = 1 in row 0, and their weights along rows and columns."""
    _, first, rows, columns, _ = pyramids
    h, w = rows[texture, level], columns[texture, level]
    x = (u - np.floor(u)) * np.float32(w) - np.float32(0.5)
    y = (np.ceil(v) - v) * np.float32(h) - np.float32(0.5)
    left, top = np.floor(x), np.floor(y)
    s, t = x - left, y - top
    i, j = int(left), int(top)
    i0 = i if i >= 0 else i + w
    j0 = j if j >= 0 else j + h
    i1 = i0 + 1 if i0 + 1 < w else 0
    j1 = j0 + 1 if j0 + 1 < h else 0
    begin = first[texture, level]
    a, b = begin + j0 * w + i0, begin + j0 * w + i1
    c, d = begin + j1 * w + i0, begin + j1 * w + i1
    return a, b, c, d, s, t


@njit(inline="always")
def channel_at(texels, channel, a, b, c, d, s, t):
    """Bilinear value of one channel."""
    one = np.float32(1)
    over = texels[a, channel] * (one - s) + texels[b, channel] * s
    under = texels[c, channel] * (one - s) + texels[d, channel] * s
    return over * (one - t) + under * t


@njit(inline="always")
def is_there(alpha, cutoff, level, row, column, triangle):
    """Whether a sample of a texture with holes is there; where a texel stands for several, as often as they are.

    The chance is that of an ordered pattern, another one for each triangle (cf. Wyman and McGuire 2017, Hashed alpha
    testing); thin needles neither vanish nor swell when they are far away.
    """
    if level == 0:
        return alpha >= cutoff
    low, high = (row ^ column) & 1, ((row ^ column) >> 1) & 1
    step = 8 * low + 4 * (row & 1) + 2 * high + ((row >> 1) & 1)
    chance = np.float32(step + 0.5) / np.float32(16) + np.float32(triangle & 1023) * np.float32(0.61803399)
    return alpha > chance - np.floor(chance)
