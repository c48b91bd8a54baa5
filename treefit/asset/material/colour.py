"""Colour: what a user may write for one, and the way between sRGB and linear light."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import ImageColor

Colour = tuple[int, int, int]
"""Red, green, blue in 0..255, sRGB."""

Floats = NDArray[np.float32]


def parse_colour(value: object) -> Colour:
    """Return (r, g, b) in 0..255 (sRGB) from '#rrggbb', a CSS colour name or three whole numbers."""
    if isinstance(value, str):
        try:
            red, green, blue = ImageColor.getrgb(value)[:3]
        except ValueError:
            raise ValueError(f"colour must be like '#6b4f3a' or a CSS colour name, got {value!r}") from None
        return int(red), int(green), int(blue)
    numbers = list(value) if isinstance(value, Sequence) else []
    if len(numbers) != 3 or not all(type(n) is int and 0 <= n <= 255 for n in numbers):
        raise ValueError(f"colour must be like '#6b4f3a' or [107, 79, 58] (numbers in 0..255), got {value!r}")
    return numbers[0], numbers[1], numbers[2]


def to_linear(colour: Colour) -> NDArray[np.float64]:
    """Linear (3,) in [0, 1] of an sRGB colour in 0..255."""
    return to_linear_light(np.array(colour) / 255)


def to_linear_light(srgb: NDArray[np.floating]) -> NDArray[np.float64]:
    """Exact linear values of sRGB (...) in [0, 1]."""
    return np.asarray(np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4))


def to_srgb(linear: Floats) -> Floats:
    """Return sRGB (..., 3) in [0, 1] of linear colours, near enough for pictures; lights over 1 are cut."""
    return np.asarray(np.clip(linear, 0, 1) ** np.float32(1 / 2.2), dtype=np.float32)


def srgb_codes(linear: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Exact sRGB (...) in 0..255 of linear values in [0, 1]."""
    cut = np.clip(linear, 0, 1)
    srgb = np.where(cut <= 0.0031308, cut * 12.92, 1.055 * cut ** (1 / 2.4) - 0.055)
    return np.asarray(np.rint(srgb * 255), dtype=np.uint8)


def of_linear(linear: NDArray[np.floating]) -> Colour:
    """Colour of linear (3,); lights over 1 are cut."""
    red, green, blue = srgb_codes(linear)
    return int(red), int(green), int(blue)
