"""Canvas: colours, noise and strokes shared by everything that is painted."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

OVERSAMPLING = 2

Colour = tuple[float, float, float]
"""Red, green, blue in 0..255."""

Light = NDArray[np.float64]
"""(h, w, 3) in 0..255."""


def blank(width: int, height: int) -> Image.Image:
    """Transparent layer of `width` x `height` final pixels, painted larger and shrunk at the end."""
    return Image.new("RGBA", (width * OVERSAMPLING, height * OVERSAMPLING), (0, 0, 0, 0))


def shrunk(layer: Image.Image) -> Image.Image:
    """`layer` at its final size with smooth edges."""
    return layer.resize((layer.width // OVERSAMPLING, layer.height // OVERSAMPLING), Image.Resampling.BOX)


def fractal(shape: tuple[int, int], cells: tuple[int, int], octaves: int, rng: np.random.Generator) -> Light:
    """(h, w) smooth noise in about -1..1; `cells` (rows, columns) is the grid of the coarsest octave."""
    total = np.zeros(shape)
    for octave in range(octaves):
        rows, columns = (count * 2**octave + 1 for count in cells)
        grid = Image.fromarray(rng.uniform(-1, 1, (rows, columns)).astype(np.float32))
        total += np.asarray(grid.resize(shape[::-1], Image.Resampling.BICUBIC)) * 0.55**octave
    return total


def ramp(position: NDArray[np.float64], stops: list[tuple[float, Colour]]) -> Light:
    """Colours (..., 3) along `position`, between the colours of `stops`."""
    places = [stop for stop, _ in stops]
    return np.stack([np.interp(position, places, [colour[c] for _, colour in stops]) for c in range(3)], axis=-1)


def tone(
    stops: list[tuple[float, Colour]], light: float, rng: np.random.Generator, jitter: float
) -> tuple[int, int, int]:
    """One colour for `light` in 0..1 along `stops`, a little changed each time, as paint is."""
    colour = ramp(np.array(light), stops) * (1 + rng.normal(0, jitter)) + rng.normal(0, 60 * jitter, 3) * (1, 0.5, 0.4)
    red, green, blue = np.clip(colour, 0, 255).astype(int)
    return int(red), int(green), int(blue)


def dab(
    draw: ImageDraw.ImageDraw, x: float, y: float, long: float, wide: float, turn: float, colour: tuple[int, ...]
) -> None:
    """A leaf: a lens of the given length and width, turned by `turn` radians."""
    along, across = (
        (math.cos(turn) * long / 2, math.sin(turn) * long / 2),
        (-math.sin(turn) * wide / 2, math.cos(turn) * wide / 2),
    )
    corners = [(1, 0), (0.4, 0.9), (-0.4, 0.9), (-1, 0), (-0.4, -0.9), (0.4, -0.9)]
    draw.polygon(
        [(x + a * along[0] + b * across[0], y + a * along[1] + b * across[1]) for a, b in corners], fill=colour
    )
