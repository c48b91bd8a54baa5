"""Noise that repeats without a seam on the unit square, drawn from a seed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.floating]  # (n, n), row 0 on top


def fractal(n: int, seed: int, finest: float, coarsest: float, slope: float = 1.0, stretch: float = 1.0) -> Field:
    """Noise (n, n) of mean 0 and deviation 1 with `coarsest` to `finest` waves a side, power falling by `slope`.

    `stretch` is how many times longer its features are upwards than across.
    """
    across, up = np.fft.rfftfreq(n, 1 / n), np.fft.fftfreq(n, 1 / n)[:, None] * stretch
    waves = np.sqrt(across**2 + up**2)
    weight = np.where(waves > 0, np.maximum(waves, 1e-9) ** -slope, 0.0)
    weight *= np.exp(-((waves / finest) ** 2)) * (1 - np.exp(-((waves / coarsest) ** 4)))
    white = np.random.default_rng(seed).standard_normal((n, n), dtype=np.float32)
    noise = np.fft.irfft2(np.fft.rfft2(white) * weight, (n, n))
    return np.asarray((noise - noise.mean()) / max(float(noise.std()), 1e-12), dtype=np.float32)


def ramp(low: float, high: float, values: Field) -> Field:
    """Smooth step from 0 at `low` to 1 at `high`."""
    t = np.clip((values - np.float32(low)) / np.float32(high - low), 0, 1)
    return np.asarray(t * t * (3 - 2 * t), dtype=np.float32)
