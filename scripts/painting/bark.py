"""Bark: a limb painted as a rounded, streaked column, light on its left side."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import ImageDraw

from painting.canvas import Colour, tone

BARK: list[tuple[float, Colour]] = [(0.0, (40, 30, 24)), (0.5, (96, 74, 56)), (1.0, (168, 138, 106))]
STRIPS = 11

Point = tuple[float, float, float]
"""x, y in painting pixels, radius."""


def paint_limb(draw: ImageDraw.ImageDraw, limb: list[Point], rng: np.random.Generator, dim: float = 0.0) -> None:
    """Paint `limb`, points (x, y, radius) from its base; `dim` darkens limbs inside a crown."""
    fine = _refined(np.array(limb))
    way = np.gradient(fine[:, :2], axis=0)
    across = np.stack((way[:, 1], -way[:, 0]), axis=1) / (np.linalg.norm(way, axis=1, keepdims=True) + 1e-9)
    # both sides share one normal at a joint, so no slit opens there; it points to the light, on the left
    across *= -np.sign(across[:, :1].sum() + 1e-9)
    strips = STRIPS if fine[0, 2] > 6 else 3
    edges = np.linspace(1, -1, strips + 1)
    furrow = rng.normal(0, 0.06, strips)
    for base in range(len(fine) - 1):
        furrow = 0.93 * furrow + rng.normal(0, 0.03, strips)
        for strip in range(strips):
            place = (edges[strip] + edges[strip + 1]) / 2
            light = 0.52 + 0.38 * place - 0.18 * place**2 - dim + furrow[strip]
            corners = [
                tuple(fine[row, :2] + across[row] * fine[row, 2] * edge)
                for row, edge in (
                    (base, edges[strip]),
                    (base + 1, edges[strip]),
                    (base + 1, edges[strip + 1]),
                    (base, edges[strip + 1]),
                )
            ]
            draw.polygon(corners, fill=(*tone(BARK, float(np.clip(light, 0, 1)), rng, 0.015), 255))


def _refined(limb: NDArray[np.float64]) -> NDArray[np.float64]:
    """`limb` with points no more than a few pixels apart, where it is thick enough for the furrows to be seen."""
    if limb[0, 2] < 6:
        return limb
    steps = np.linspace(0, len(limb) - 1, max(len(limb), int(np.ptp(limb[:, 1]) / 7)))
    return np.stack([np.interp(steps, np.arange(len(limb)), limb[:, column]) for column in range(3)], axis=1)
