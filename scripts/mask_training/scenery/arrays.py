"""Arrays of the scenery: pictures have display values in [0, 1], row 0 on top."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float32 | np.float64]
Image: TypeAlias = NDArray[np.float32 | np.float64]  # (h, w, 3)
Field: TypeAlias = NDArray[np.float32 | np.float64]  # (h, w)
Bools: TypeAlias = NDArray[np.bool_]
Classes: TypeAlias = NDArray[np.uint8]  # (h, w), those of treefit.mask
Colour: TypeAlias = tuple[float, float, float]  # display values in [0, 1]
Rng: TypeAlias = np.random.Generator


def blend(under: Image, colour: Floats | Colour, opacity: Field) -> None:
    """Lay `colour`, one or a picture, over `under` with `opacity` (h, w), in place."""
    under += (np.asarray(colour, np.float32) - under) * opacity[..., None]


def smoothstep(x: Field, low: float, high: float) -> Field:
    """0 below `low`, 1 above `high`, smooth between."""
    t = np.clip((x - low) / (high - low), 0, 1).astype(np.float32)
    smooth: Field = t * t * (3 - 2 * t)
    return smooth


def chance(rng: Rng, share: float) -> bool:
    """True in `share` of the draws."""
    return bool(rng.random() < share)


def tinted(colour: Colour, rng: Rng, spread: float) -> Colour:
    """`colour` lighter or darker, and a little of another hue."""
    tone = np.exp(rng.normal(0, spread)) * np.exp(rng.normal(0, spread * 0.4, 3))
    r, g, b = np.clip(np.asarray(colour) * tone, 0, 1)
    return float(r), float(g), float(b)
