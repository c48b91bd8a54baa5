"""A material's base texture with its colour in it, for formats where programs do not agree on how both are mixed."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from treefit.asset.material.colour import Colour, to_linear
from treefit.asset.material.material import Material, Texels


def tinted(material: Material) -> Texels | None:
    """Return the base texture times the colour (in linear light), sRGB; alpha stays. None without a texture."""
    base = material.base
    if base is None or material.colour == (255, 255, 255):
        return base
    return np.dstack([_curves(material.colour)[base[..., :3], np.arange(3)], base[..., 3:]])


@lru_cache(maxsize=8)
def _curves(colour: Colour) -> Texels:
    """Tinted value (256, 3) of each value in each channel."""
    linear = np.array([to_linear((value, value, value)) for value in range(256)]) * to_linear(colour)
    srgb = np.where(linear <= 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.asarray(np.rint(srgb * 255), dtype=np.uint8)
