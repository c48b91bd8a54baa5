"""Silhouettes: what of a model stands out against the sky, and how far two of them agree."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.lod.view import Extent, View, side_view
from treefit.asset.model import Model, Part

Coverage = NDArray[np.uint8]  # (h, w), samples of each pixel that the model covers

AZIMUTHS = (0.0, 45.0, 90.0, 135.0)
"""Degrees; the other four of a turn show the same outlines mirrored."""
ROWS = 256
_FINER = 4  # samples a pixel along each side

_SOLID = np.full((1, 1), 255, dtype=np.uint8)


@dataclass(frozen=True, eq=False)
class Silhouettes:
    """The coverage of a model's pixels from every side of `AZIMUTHS`."""

    extent: Extent
    coverage: tuple[Coverage, ...]

    @property
    def fill(self) -> float:
        """Share of the model between the outermost pixels of every row that is not sky."""
        return float(np.mean([_fill(coverage) for coverage in self.coverage]))


def silhouettes(model: Model, extent: Extent | None = None, azimuths: Sequence[float] = AZIMUTHS) -> Silhouettes:
    """Return the silhouettes of `model`, the union of its triangles less their holes; orthographic, `ROWS` high.

    Pixels have 4 x 4 samples: twigs and gaps finer than a pixel count by their share of it, as a viewer sees them.
    `extent` is that of the model with which they shall be compared.
    """
    extent = extent or Extent.of([part.mesh.vertices for part in model.parts.values()])
    views = [side_view(extent, degrees, ROWS * _FINER) for degrees in azimuths]
    return Silhouettes(extent, tuple(_counted(covered(model.parts.values(), view)) for view in views))


def silhouette_iou(a: Silhouettes, b: Silhouettes) -> float:
    """Return intersection over union of coverage, sum of min / sum of max over all pixels; mean over the sides."""
    shares = []
    for one, other in zip(a.coverage, b.coverage, strict=True):
        union = int(np.maximum(one, other).sum(dtype=np.int64))
        shares.append(int(np.minimum(one, other).sum(dtype=np.int64)) / union if union else 1.0)
    return float(np.mean(shares))


def covered(parts: Iterable[Part], view: View) -> NDArray[np.bool_]:
    """Samples (rows, columns) of `view` whose centre any triangle of `parts` covers where its alpha passes."""
    out = np.zeros((view.rows, view.columns), dtype=np.bool_)
    for part in parts:
        alpha, cutoff = holes(part)
        cover(view.project(part.mesh.vertices), part.mesh.faces, part.mesh.uv, alpha, np.float32(cutoff), out)
    return out


def holes(part: Part) -> tuple[NDArray[np.uint8], float]:
    """Alpha (h, w) of the material of `part` and the value from which there is something; one texel when all is."""
    material = part.material
    if material.base is None or material.cutoff is None or material.base.shape[2] < 4:
        return _SOLID, 0.0
    return np.ascontiguousarray(material.base[..., 3]), 255 * material.cutoff


def _fill(coverage: Coverage) -> float:
    inside = (np.cumsum(coverage, axis=1) > 0) & (np.cumsum(coverage[:, ::-1], axis=1) > 0)[:, ::-1]
    return float(coverage[inside].mean()) / _FINER**2 if inside.any() else 0.0


def _counted(samples: NDArray[np.bool_]) -> Coverage:
    rows, columns = (-(-size // _FINER) * _FINER for size in samples.shape)
    whole = np.zeros((rows, columns), dtype=np.uint8)
    whole[: samples.shape[0], : samples.shape[1]] = samples
    blocks = whole.reshape(rows // _FINER, _FINER, columns // _FINER, _FINER)
    return np.asarray(blocks.sum(axis=(1, 3), dtype=np.uint8), dtype=np.uint8)


@njit(cache=True, nogil=True, error_model="numpy")
def cover(screen, faces, uv, alpha, cutoff, out):
    """Mark the samples of `out` whose centres the triangles cover; one texel of `alpha` is no hole anywhere."""
    height, width = out.shape
    half, none, one = np.float32(0.5), np.float32(0), np.float32(1)
    solid = alpha.size == 1
    for f in range(faces.shape[0]):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        ax, ay = screen[a, 0], screen[a, 1]
        bx, by = screen[b, 0] - ax, screen[b, 1] - ay
        cx, cy = screen[c, 0] - ax, screen[c, 1] - ay
        area = bx * cy - cx * by
        if area == 0:
            continue
        share = one / area
        left = max(int(np.ceil(ax + min(none, bx, cx) - half)), 0)
        right = min(int(np.floor(ax + max(none, bx, cx) - half)), width - 1)
        top = max(int(np.ceil(ay + min(none, by, cy) - half)), 0)
        bottom = min(int(np.floor(ay + max(none, by, cy) - half)), height - 1)
        for r in range(top, bottom + 1):
            y = np.float32(r) + half - ay
            for col in range(left, right + 1):
                if out[r, col]:
                    continue
                x = np.float32(col) + half - ax
                w1, w2 = (x * cy - cx * y) * share, (bx * y - x * by) * share
                if w1 < 0 or w2 < 0 or w1 + w2 > 1:
                    continue
                if not solid:
                    w0 = one - w1 - w2
                    u = w0 * uv[a, 0] + w1 * uv[b, 0] + w2 * uv[c, 0]
                    v = w0 * uv[a, 1] + w1 * uv[b, 1] + w2 * uv[c, 1]
                    if texel(alpha, u, v) < cutoff:
                        continue
                out[r, col] = True


@njit(cache=True, nogil=True)
def texel(alpha, u, v):
    """Value of the texture (h, w) at (u, v), bilinear, repeated; v = 1 is its top."""
    h, w = alpha.shape
    x, y = u * w - np.float32(0.5), (1 - v) * h - np.float32(0.5)
    left, top = int(np.floor(x)), int(np.floor(y))
    s, t = np.float32(x - left), np.float32(y - top)
    left, right, top, bottom = left % w, (left + 1) % w, top % h, (top + 1) % h
    high = alpha[top, left] * (1 - s) + alpha[top, right] * s
    low = alpha[bottom, left] * (1 - s) + alpha[bottom, right] * s
    return np.float32(high * (1 - t) + low * t)
