"""Camera: exposure, colour, focus, noise and the file format, from a painted scene to a picture."""

from __future__ import annotations

import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Pillow
from scipy.ndimage import gaussian_filter, uniform_filter1d

from scripts.mask_training.scenery.arrays import Field, Image, Rng, chance


def photographed(scene: Image, rng: Rng) -> NDArray[np.uint8]:
    """`scene` (h, w, 3) as a camera gives it, uint8."""
    picture = _lens(np.clip(scene, 0, 1).astype(np.float32), rng)
    picture = _tones(picture, rng)
    if chance(rng, 0.5):
        grain = 0.002 + 0.028 * rng.random() ** 3
        noise = rng.standard_normal(picture.shape, dtype=np.float32)
        picture = picture + grain * (noise if chance(rng, 0.5) else noise[..., :1])
    return written(picture, rng)


def written(picture: Image, rng: Rng) -> NDArray[np.uint8]:
    """uint8 picture after the way through files: smaller and back, sharpened, JPEG."""
    height, width = picture.shape[:2]
    image = Pillow.fromarray((np.clip(picture, 0, 1) * 255 + 0.5).astype(np.uint8))
    if chance(rng, 0.12):
        share = rng.uniform(0.5, 0.95)
        kind = Pillow.Resampling.BILINEAR if chance(rng, 0.5) else Pillow.Resampling.BICUBIC
        image = image.resize((max(8, int(width * share)), max(8, int(height * share))), kind).resize(
            (width, height), kind
        )
    if chance(rng, 0.45):
        plain = np.asarray(image, np.float32)
        soft = gaussian_filter(plain, (0.8, 0.8, 0))
        image = Pillow.fromarray(np.clip(plain + rng.uniform(0.2, 1.0) * (plain - soft), 0, 255).astype(np.uint8))
    if chance(rng, 0.6):
        file = io.BytesIO()
        image.save(file, "JPEG", quality=int(rng.integers(30, 96)))
        image = Pillow.open(file)
    return np.array(image.convert("RGB"))


def _lens(picture: Image, rng: Rng) -> Image:
    """Focus, motion, fringes of colour and darker corners."""
    size = len(picture)
    if chance(rng, 0.16):
        sigma = abs(rng.normal(0, 0.003)) * size
        picture = gaussian_filter(picture, (sigma, sigma, 0), truncate=2.5)
    elif chance(rng, 0.03):
        picture = uniform_filter1d(picture, max(2, int(rng.uniform(0.005, 0.02) * size)), axis=int(rng.integers(2)))
    if chance(rng, 0.1):
        picture = np.stack(
            [np.roll(picture[..., 0], 1, axis=1), picture[..., 1], np.roll(picture[..., 2], -1, axis=1)], axis=2
        )
    if chance(rng, 0.3):
        picture = picture * (1 - rng.uniform(0.05, 0.45) * _corners(size))[..., None].astype(np.float32)
    return picture


def _corners(size: int) -> Field:
    t = np.linspace(-1, 1, size, dtype=np.float32) ** 2
    far: Field = ((t[:, None] + t[None]) / 2) ** 1.5
    return far


def _tones(picture: Image, rng: Rng) -> Image:
    """Exposure, contrast, saturation, white balance, gamma, haze of the lens."""
    grey = picture @ np.array([0.3, 0.59, 0.11], np.float32)
    saturation = float(np.clip(rng.normal(1.08, 0.2), 0.2, 1.7)) if chance(rng, 0.975) else 0.0
    picture = grey[..., None] + (picture - grey[..., None]) * saturation
    middle, contrast = rng.uniform(0.42, 0.58), float(np.exp(rng.normal(0.08, 0.13)))
    gains = contrast * np.exp(rng.normal(0, 0.13)) * np.exp(rng.normal(0, 0.03, 3))
    picture = np.clip(picture * gains.astype(np.float32) + middle * (1 - contrast), 0, 1)
    gamma = np.float32(np.exp(rng.normal(0, 0.14)))
    if abs(gamma - 1) > 0.05:
        picture = picture**gamma
    if chance(rng, 0.12):
        veil = rng.uniform(0.03, 0.2)
        picture = picture * (1 - veil) + veil * rng.uniform(0.6, 1.0)
    return picture
