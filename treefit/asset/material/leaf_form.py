"""Leaf forms: the fine outline of a blade, inside its mesh where that bulges; the alpha of its texture."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from treefit.asset.material.noise import Field
from treefit.asset.mesh.blade import area_scale, half_of
from treefit.asset.mesh.leaf_frame import LeafFrame

Points = NDArray[np.float64]  # (m, 2)

BASE = 0.07
"""Length of the bare stalk."""
_FINER = 3

# Right half in the units of the mesh's half before it is scaled.
_OAK = (
    (0.03, 0.08), (0.16, 0.10), (0.32, 0.20), (0.27, 0.31), (0.10, 0.34), (0.11, 0.40), (0.34, 0.50), (0.46, 0.64),
    (0.36, 0.71), (0.14, 0.67), (0.13, 0.73), (0.32, 0.80), (0.29, 0.94), (0.15, 0.89), (0.10, 0.99), (0.0, 1.0),
)  # fmt: skip
_MAPLE = (
    (0.0, 0.07), (0.07, 0.045), (0.15, 0.055), (0.24, 0.03), (0.37, 0.03), (0.31, 0.09), (0.335, 0.155), (0.26, 0.17),
    (0.19, 0.24), (0.26, 0.275), (0.315, 0.265), (0.34, 0.34), (0.425, 0.365), (0.42, 0.445), (0.52, 0.575),
    (0.44, 0.56), (0.40, 0.605), (0.345, 0.555), (0.28, 0.59), (0.15, 0.49), (0.165, 0.60), (0.25, 0.665), (0.18, 0.70),
    (0.19, 0.76), (0.11, 0.80), (0.10, 0.865), (0.0, 1.0),
)  # fmt: skip
_TEETH = {"broad": (38, 0.022), "round": (30, 0.016), "narrow": (60, 0.008)}  # on one half; depth by the half's width


def blade_form(shape: str) -> Points:
    """Closed outline (m, 2) of a blade without its stalk, in the places of the leaf."""
    if shape == "oak":
        right = _rounded(np.array(_OAK), 3)
    elif shape == "lobed":
        right = _rounded(np.array(_MAPLE), 1)
    else:
        right = _toothed(shape, _rounded(np.r_[[[0, BASE]], half_of(shape), [[0, 1]]], 5))
    if shape in ("oak", "lobed"):
        right = right * [area_scale(shape), 1]
    return np.concatenate([right, (right * [-1, 1])[::-1]])


def inside(form: Points, frame: LeafFrame, n: int) -> Field:
    """Share (n, n) of each texel of the square of `frame` that is within `form`."""
    return coverage([form], frame, n)


def coverage(forms: list[Points], frame: LeafFrame, n: int) -> Field:
    """Share (n, n) of each texel that is within one of `forms` (m, 2)."""
    image = Image.new("L", (n * _FINER, n * _FINER))
    pen = ImageDraw.Draw(image)
    for form in forms:
        pen.polygon(texels(form, frame, n * _FINER).ravel().tolist(), fill=255)
    return np.asarray(image.reduce(_FINER), dtype=np.float32) / np.float32(255)


def texels(points: Points, frame: LeafFrame, n: int) -> Points:
    """Column and row (m, 2) of places of the leaf in a texture of n by n."""
    uv = frame.uv(*points.T)
    return np.column_stack([uv[:, 0], 1 - uv[:, 1]]) * n - 0.5


def _rounded(points: Points, times: int) -> Points:
    """Corners cut at a quarter of their sides, again and again; the ends stay (Chaikin 1974)."""
    for _ in range(times):
        cut = np.stack([0.75 * points[:-1] + 0.25 * points[1:], 0.25 * points[:-1] + 0.75 * points[1:]], axis=1)
        points = np.r_[points[:1], cut.reshape(-1, 2), points[-1:]]
    return points


def _toothed(shape: str, half: Points) -> Points:
    """The half with teeth that point to the tip, as its species has them."""
    if shape not in _TEETH:
        return half
    count, depth = _TEETH[shape]
    far = np.r_[0, np.cumsum(np.linalg.norm(np.diff(half, axis=0), axis=1))]
    at = np.linspace(0, 1, 8 * count + 1)
    line = np.column_stack([np.interp(at * far[-1], far, half[:, axis]) for axis in (0, 1)])
    saw = (at * count) % 1.0
    line[:, 0] *= 1 - depth * (1 - saw) * np.minimum(1, 6 * at)
    return line
