"""Noise: smooth fields of chance in a plane, along a line and on ground seen in perspective."""

from __future__ import annotations

import numpy as np
from numba import njit
from PIL import Image as Pillow

from scripts.mask_training.scenery.arrays import Field, Floats, Rng
from scripts.mask_training.scenery.kernels import INNER, KERNEL


def fractal(
    height: int, width: int, cell: float, rng: Rng, octaves: int = 4, fall: float = 0.55, stretch: float = 1.0
) -> Field:
    """Field (height, width) of mean 0 and deviation 1; `cell` pixels a bump, wider by `stretch` than high."""
    total = np.zeros((height, width), np.float32)
    weight = 1.0
    for _ in range(octaves):
        rows, columns = max(2, round(height / cell) + 2), max(2, round(width / (cell * stretch)) + 2)
        coarse = rng.standard_normal((rows, columns), dtype=np.float32)
        if rows >= height or columns >= width:
            rows, columns = min(rows, height), min(columns, width)
            coarse = np.ascontiguousarray(coarse[:rows, :columns])
        # bumps of a few pixels look the same either way
        smooth = Pillow.Resampling.BICUBIC if cell > 5 else Pillow.Resampling.BILINEAR
        total += np.float32(weight) * np.asarray(Pillow.fromarray(coarse).resize((width, height), smooth))
        weight, cell = weight * fall, cell / 2
        if cell < 1:
            break
    total -= total.mean()
    total /= max(float(total.std()), 1e-6)
    return total


def line(width: int, cell: float, rng: Rng, octaves: int = 5, fall: float = 0.5) -> Floats:
    """Numbers (width,) of mean 0 and deviation 1, `cell` pixels a bump."""
    flat: Floats = fractal(3, width, cell, rng, octaves, fall)[1]
    centred: Floats = (flat - flat.mean()) / max(float(flat.std()), 1e-6)
    return centred


@njit(**INNER)
def _hash(x: int, y: int, seed: int) -> float:
    """Number in [0, 1) of a lattice point."""
    n = np.uint32(x * 374761393 + y * 668265263 + seed * 974634777)
    n = np.uint32((n ^ (n >> np.uint32(13))) * np.uint32(1274126177))
    n = np.uint32(n ^ (n >> np.uint32(16)))
    return float(n & np.uint32(0xFFFFFF)) / 16777216.0


@njit(**INNER)
def value_noise(x: float, y: float, seed: int) -> float:
    """Smooth number in [0, 1) at a place of the plane; bumps of length 1."""
    ix, iy = int(np.floor(x)), int(np.floor(y))
    fx, fy = x - ix, y - iy
    fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)
    top = _hash(ix, iy, seed) * (1 - fx) + _hash(ix + 1, iy, seed) * fx
    bottom = _hash(ix, iy + 1, seed) * (1 - fx) + _hash(ix + 1, iy + 1, seed) * fx
    return top * (1 - fy) + bottom * fy


@njit(**KERNEL)
def on_ground(height: int, width: int, horizon: float, frequency: float, octaves: int, seed: int) -> Field:
    """Noise (height, width) of about [-1, 1] on the ground below row `horizon`, finer towards it; 0 above.

    At the lower edge of a picture bumps are 1 / `frequency` of its width.
    """
    field = np.zeros((height, width), np.float32)
    reach = max(height - horizon, 1.0)
    for r in range(max(0, int(horizon) + 1), height):
        away = reach / (r + 0.5 - horizon)
        for c in range(width):
            x, z = (c - width * 0.5) / width * away * frequency, away * frequency * 0.6
            total, weight, scale = 0.0, 1.0, 1.0
            for octave in range(octaves):
                # bumps finer than a pixel would only be grain
                if away * frequency * scale > width * 0.7:
                    break
                total += weight * (2 * value_noise(x * scale, z * scale, seed + octave) - 1)
                weight, scale = weight * 0.6, scale * 2.1
            field[r, c] = total
    return field
