"""Layers: numba kernels that lay one picture over another."""

from __future__ import annotations

from numba import njit

from scripts.mask_training.scenery.arrays import Field, Floats, Image
from scripts.mask_training.scenery.kernels import KERNEL


@njit(**KERNEL)
def over_picture(paint: Floats, colour: Image, opacity: Field) -> None:
    """Lay `colour` (h, w, 3) over `paint` (h, w, 4), whose fourth channel becomes at least `opacity` (h, w)."""
    for r in range(paint.shape[0]):
        for c in range(paint.shape[1]):
            share = opacity[r, c]
            if share > 0:
                for k in range(3):
                    paint[r, c, k] += (colour[r, c, k] - paint[r, c, k]) * share
                paint[r, c, 3] = max(paint[r, c, 3], share)


@njit(**KERNEL)
def over_colour(paint: Floats, colour: Floats, opacity: Field) -> None:
    """Lay one `colour` (3,) over `paint` as over_picture does."""
    for r in range(paint.shape[0]):
        for c in range(paint.shape[1]):
            share = opacity[r, c]
            if share > 0:
                for k in range(3):
                    paint[r, c, k] += (colour[k] - paint[r, c, k]) * share
                paint[r, c, 3] = max(paint[r, c, 3], share)


@njit(**KERNEL)
def darken(paint: Floats, factor: Field) -> None:
    """Multiply the colours of `paint` (h, w, 4) by `factor` (h, w)."""
    for r in range(paint.shape[0]):
        for c in range(paint.shape[1]):
            for k in range(3):
                paint[r, c, k] *= factor[r, c]
