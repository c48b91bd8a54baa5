"""Strokes: leaves of many slips, each drawn as a slim form over those before it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from treefit.asset.material.leaf_form import texels
from treefit.asset.mesh.leaf_frame import LeafFrame

Floats = NDArray[np.float64]
Values = NDArray[np.floating]  # (m,), of the samples that are on a stroke
Profile = tuple[tuple[float, float], ...]

_FINER = 2


@dataclass(frozen=True, eq=False)
class Strokes:
    """Slips (s,) in the order in which they are drawn, in the places of the leaf."""

    base: Floats  # (s, 2)
    tip: Floats  # (s, 2)
    width: Floats  # (s,) half width where it is widest
    shade: Floats  # (s,) how light it is
    wood: Floats  # (s,) 1 for twigs, 0 for leaves


def layered(parts: Sequence[Strokes]) -> Strokes:
    """Return all `parts`, each over the one before it."""
    names = ("base", "tip", "width", "shade", "wood")
    return Strokes(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


@dataclass(frozen=True, eq=False)
class Samples:
    """What is seen at the samples (m,) that are on a stroke, four a texel."""

    size: int  # texels along a side
    texel: NDArray[np.intp]
    along: Values  # 0 at the base of the stroke to 1 at its tip
    across: Values  # -1 to 1
    shade: Values
    wood: Values
    order: Values  # in (0, 1], 1 on top

    def share(self) -> Values:
        """Share (n, n) of each texel that is on a stroke."""
        return self._sums(None) / np.float32(_FINER**2)

    def mean(self, values: Values) -> Values:
        """Means (n, n) of `values` (m,) over the samples of each texel, 0 where there are none."""
        return self._sums(values) / np.maximum(self._sums(None), 1)

    def _sums(self, values: Values | None) -> Values:
        sums = np.bincount(self.texel, values, self.size**2)
        return sums.astype(np.float32).reshape(self.size, self.size)


def draw(strokes: Strokes, profile: Profile, frame: LeafFrame, n: int) -> Samples:
    """Draw `strokes` with the half outline `profile`: places along and, by the width, across."""
    outline = np.array([*profile, *((along, -across) for along, across in reversed(profile))])
    way = strokes.tip - strokes.base
    long = np.linalg.norm(way, axis=1, keepdims=True)
    right = np.column_stack([way[:, 1], -way[:, 0]]) / long
    corners = strokes.base[:, None] + outline[None, :, :1] * way[:, None]
    corners = corners + outline[None, :, 1:] * (right * strokes.width[:, None])[:, None]
    corners = texels(corners.reshape(-1, 2), frame, n * _FINER).reshape(len(way), -1)
    image = Image.new("I", (n * _FINER, n * _FINER))
    pen = ImageDraw.Draw(image)
    for number, polygon in enumerate(corners.tolist(), 1):
        pen.polygon(polygon, fill=number)
    told = (strokes.base, way / long**2, right / strokes.width[:, None], strokes.shade, strokes.wood)
    return _samples(np.asarray(image), np.column_stack(told).astype(np.float32), frame)


def _samples(index: NDArray[np.int32], told: Values, frame: LeafFrame) -> Samples:
    n = len(index)
    at = (np.arange(n) + 0.5) / n
    x, y = frame.xy(np.column_stack([at, 1 - at])).astype(np.float32).T
    row, column = np.nonzero(index)
    number = index[row, column] - 1
    base_x, base_y, way_x, way_y, right_x, right_y, shade, wood = np.ascontiguousarray(told.T)[:, number]
    dx, dy = x[column] - base_x, y[row] - base_y
    size = n // _FINER
    return Samples(
        size, row // _FINER * size + column // _FINER,
        dx * way_x + dy * way_y, dx * right_x + dy * right_y, shade, wood,
        (number + 1) / np.float32(len(told)),
    )  # fmt: skip
