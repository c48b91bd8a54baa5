"""A drawn photograph: two like trees on a lawn before a hedge, with what is truly tree."""

from __future__ import annotations

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

from treefit.image.picture import Picture
from treefit.mask import BRANCH, FOLIAGE, Mask

SIZE = (360, 300)
LEFT, RIGHT = 100, 265
"""Columns of the two trunks."""


def scene(seed: int = 0) -> Picture:
    """The picture, (300, 360)."""
    rng = np.random.default_rng(seed)
    image = Image.new("RGB", SIZE, (150, 190, 235))
    draw = ImageDraw.Draw(image)
    draw.rectangle((0, 190, 360, 300), fill=(60, 120, 50))
    draw.rectangle((0, 170, 360, 215), fill=(50, 90, 45))
    for x in (LEFT, RIGHT):
        draw.rectangle((x - 7, 150, x + 7, 260), fill=(105, 75, 50))
        draw.ellipse((x - 60, 40, x + 60, 190), fill=(55, 125, 40))
    noise = rng.normal(0, 14, (SIZE[1], SIZE[0], 1))
    noise[:165] *= (np.asarray(image)[:165, :, 2] < 200)[..., None]
    pixels = np.clip(np.asarray(image) + noise, 0, 255).astype(np.uint8)
    return Picture(np.asarray(Image.fromarray(pixels).filter(ImageFilter.GaussianBlur(0.7))))


def truth(*columns: int) -> Mask:
    """Mask of the trees at `columns`."""
    image = Image.new("L", SIZE)
    draw = ImageDraw.Draw(image)
    for x in columns:
        draw.rectangle((x - 7, 150, x + 7, 260), fill=BRANCH)
        draw.ellipse((x - 60, 40, x + 60, 190), fill=FOLIAGE)
    return np.asarray(image)


def overlap(mask: Mask, expected: Mask) -> float:
    """Intersection over union of the tree."""
    return float(((mask > 0) & (expected > 0)).sum() / ((mask > 0) | (expected > 0)).sum())
