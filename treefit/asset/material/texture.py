"""Textures: what is drawn of a surface becomes base colour, normals and roughness in 8 bits."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from treefit.asset.material.colour import Colour, of_linear, srgb_codes, to_linear, to_linear_light
from treefit.asset.material.material import Texels
from treefit.asset.material.noise import Field

Colours = NDArray[np.floating]  # (n, n, 3)

CUTOFF = 0.4
"""Alpha of a leaf texture under which there is nothing: under a half, or thin needles go away with distance."""
_BRIGHT = 0.995  # share of the texels that keep their colour; brighter ones are cut


@dataclass(frozen=True, eq=False)
class Drawing:
    """A surface as it is drawn: row 0 on top."""

    tone: Colours  # (n, n, 3) linear; only how they differ from their mean counts
    height: Field  # (n, n) in sides of the texture
    roughness: Field  # (n, n) in [0, 1]
    alpha: Field | None = None  # (n, n) in [0, 1]

    def coarser(self, by: int) -> Drawing:
        """The same with one texel, their mean, for `by` by `by`."""
        tone, height, roughness, alpha = (
            None if part is None else _means(part, by) for part in (self.tone, self.height, self.roughness, self.alpha)
        )
        assert tone is not None
        assert height is not None
        assert roughness is not None
        return Drawing(tone, height, roughness, alpha)


@dataclass(frozen=True, eq=False)
class Textures:
    """Texels of a surface whose mean colour is light and neutral; a material's colour gives it its hue."""

    base: Texels  # (n, n, 3 or 4) sRGB
    normal: Texels  # (n, n, 3)
    roughness: Texels  # (n, n)

    @cached_property
    def mean(self) -> NDArray[np.float64]:
        """Linear mean (3,) of the texels that are there."""
        seen = self.base[..., :3][self.base[..., 3] >= 255 * CUTOFF] if self.base.shape[2] == 4 else self.base
        return np.array([_LINEAR[channel].mean() for channel in seen.reshape(-1, 3).T])

    def coloured(self, wished: Colour) -> tuple[Colour, Texels]:
        """Colour and base texture whose product has `wished` as its mean.

        A colour lighter than the texture's mean takes contrast from the texture: none is left in white.
        """
        target, mean = to_linear(wished), self.mean
        lifted = np.clip((1 - target) / np.maximum(1 - mean, 1e-6), 0, 1)
        if (lifted == 1).all():
            return of_linear(target / mean), self.base
        curves = srgb_codes(1 - (1 - _LINEAR[:, None]) * lifted)
        base = np.dstack([curves[self.base[..., :3], np.arange(3)], self.base[..., 3:]])
        return of_linear(target / (1 - (1 - mean) * lifted)), base


_LINEAR = to_linear_light(np.arange(256) / 255)
"""Linear light of each sRGB code."""


def textures_of(drawing: Drawing) -> Textures:
    """Return `drawing` as texels; its colours are made as light as they can be, each channel to the same mean."""
    seen = np.ones(drawing.height.shape, bool) if drawing.alpha is None else drawing.alpha >= CUTOFF
    tone = drawing.tone if drawing.alpha is None else _bled(drawing.tone, drawing.alpha)
    tone = tone / tone[seen].mean(axis=0)
    tone /= np.quantile(tone[seen].max(axis=-1), _BRIGHT)
    base = srgb_codes(np.clip(tone, 0, 1))
    if drawing.alpha is not None:
        base = np.dstack([base, _code(drawing.alpha)])
    return Textures(base, _normals(drawing.height), _code(drawing.roughness))


def _normals(height: Field) -> Texels:
    """Normals of a height field that repeats: red to the right, green up."""
    slope = len(height) / 2
    right = (np.roll(height, 1, 1) - np.roll(height, -1, 1)) * np.float32(slope)
    up = (np.roll(height, -1, 0) - np.roll(height, 1, 0)) * np.float32(slope)
    out = 1 / np.sqrt(right**2 + up**2 + 1)
    return _code(np.stack([right * out, up * out, out], axis=-1) / 2 + np.float32(0.5))


def _means(values: NDArray[np.floating], by: int) -> NDArray[np.floating]:
    n = len(values) // by
    return np.asarray(values.reshape(n, by, n, by, *values.shape[2:]).mean(axis=(1, 3)))


def _bled(tone: Colours, alpha: Field) -> Colours:
    """`tone` where there is something, around it the mean of what is near, so that coarser levels have no rim."""
    weight = np.maximum(alpha, 1e-6)[..., None]
    colour, weights = [tone * weight], [weight]
    while len(colour[-1]) % 2 == 0 and len(colour[-1]) > 1:
        colour.append(_means(colour[-1], 2))
        weights.append(_means(weights[-1], 2))
    filled = colour[-1] / weights[-1]
    for part, share in zip(colour[-2::-1], weights[-2::-1], strict=True):
        filled = filled.repeat(2, 0).repeat(2, 1)
        sure = np.minimum(share * 4, 1)
        filled = sure * (part / share) + (1 - sure) * filled
    return np.asarray(filled, dtype=np.float32)


def _code(values: NDArray[np.floating]) -> Texels:
    return np.asarray(np.clip(values, 0, 1) * 255 + 0.5, dtype=np.uint8)
