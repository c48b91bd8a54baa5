"""Landscape: sky with clouds, hills in haze, a lawn with grass, and the shadow that a tree throws on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

from painting.canvas import OVERSAMPLING, Colour, Light, dab, fractal, ramp, tone

SKY = [(0.0, (74, 128, 190)), (0.55, (150, 190, 224)), (1.0, (226, 232, 226))]
GRASS = [(0.0, (48, 78, 26)), (0.5, (104, 140, 52)), (1.0, (176, 190, 92))]


@dataclass(frozen=True)
class Scene:
    """Size in final pixels, horizon as share of the height, cloudiness 0..1, colours of hills from far to near."""

    width: int
    height: int
    horizon: float
    clouds: float
    hills: tuple[Colour, ...]


def paint(scene: Scene, rng: np.random.Generator) -> Image.Image:
    """The landscape without a tree, at painting size."""
    size = (scene.height * OVERSAMPLING, scene.width * OVERSAMPLING)
    picture = _sky(size, scene, rng)
    _hills(picture, scene, rng)
    _lawn(picture, scene, rng)
    image = Image.fromarray(np.clip(picture, 0, 255).astype(np.uint8))
    # what is far is a little out of focus, as behind a portrait
    image = image.filter(ImageFilter.GaussianBlur(2.2))
    _blades(image, scene, rng)
    return image


def throw_shadow(image: Image.Image, x: float, y: float, long: float, wide: float, rng: np.random.Generator) -> None:
    """Darken the lawn around (x, y) with a soft dappled ellipse of half axes `long`, `wide` in painting pixels."""
    rows, columns = np.mgrid[: image.height, : image.width]
    reach = np.sqrt(((columns - x) / long) ** 2 + ((rows - y) / wide) ** 2)
    dapple = fractal((image.height, image.width), (160, 40), 3, rng)
    dense = np.clip((1.12 - reach) / 0.5, 0, 1) * np.clip(0.82 + 0.35 * dapple, 0, 1)
    mask = Image.fromarray((200 * dense).astype(np.uint8)).filter(ImageFilter.GaussianBlur(3))
    dark = Image.fromarray((np.asarray(image) * np.array([0.36, 0.44, 0.5])).astype(np.uint8))
    image.paste(dark, (0, 0), mask)


def _sky(size: tuple[int, int], scene: Scene, rng: np.random.Generator) -> Light:
    height, width = size
    rows = np.linspace(0, 1 / scene.horizon, height)[:, None].repeat(width, axis=1)
    sky = ramp(np.clip(rows, 0, 1), SKY)
    # clouds flatten towards the horizon
    puffs = fractal(size, (7, 3), 6, rng) + 0.25 * fractal(size, (3, 2), 2, rng)
    cover = np.clip((puffs - 0.75 + scene.clouds) / 0.9, 0, 1) ** 1.3 * np.clip(1.25 - 0.7 * rows, 0, 1)
    below = np.roll(puffs, -size[0] // 50, axis=0)
    lit = np.clip(0.72 + 0.28 * (puffs - below), 0.6, 1)[..., None]
    white = np.array([252, 250, 246]) * lit + np.array([160, 172, 196]) * (1 - lit)
    return np.asarray(sky + (white - sky) * cover[..., None] * 0.9)


def _hills(picture: Light, scene: Scene, rng: np.random.Generator) -> None:
    height, width = picture.shape[:2]
    ground = scene.horizon * height
    for index, colour in enumerate(scene.hills):
        nearness = index / max(1, len(scene.hills) - 1)
        line = fractal((2, width), (1, 2 + 2 * index), 3 + 2 * index, rng)[0]
        top = ground - height * (0.075 - 0.055 * nearness) - line * height * (0.03 - 0.012 * nearness)
        inside = np.arange(height)[:, None] > top
        mottle = 1 + 0.05 * nearness * fractal((height, width), (40, 30), 3, rng)[..., None]
        haze = np.clip((np.arange(height)[:, None] - top) / (0.1 * height), 0, 1)[..., None] * 12
        picture[inside] = (np.array(colour) * mottle + haze)[inside]


def _lawn(picture: Light, scene: Scene, rng: np.random.Generator) -> None:
    height, width = picture.shape[:2]
    start = int(scene.horizon * height)
    depth = np.linspace(0, 1, height - start)[:, None]
    patches = fractal((height - start, width), (9, 3), 5, rng)
    light = np.clip(0.72 - 0.30 * depth + 0.16 * patches, 0, 1)
    picture[start:] = ramp(light, GRASS)


def _blades(image: Image.Image, scene: Scene, rng: np.random.Generator) -> None:
    """Grass, finer and denser the farther away; a few flowers."""
    draw = ImageDraw.Draw(image)
    start = scene.horizon * image.height
    depths = np.sort(rng.uniform(0.12, 1, 15000) ** 0.75)
    for depth in depths:
        x, y = rng.uniform(0, image.width), start + depth * (image.height - start)
        long = (4 + 22 * depth**1.5) * rng.uniform(0.6, 1.3)
        colour = tone(GRASS, 0.62 - 0.3 * depth + rng.normal(0, 0.16), rng, 0.06)
        draw.line((x, y, x + rng.normal(0, 0.3) * long, y - long), fill=colour, width=1 + int(1.6 * depth))
    for _ in range(110):
        depth = rng.uniform(0.15, 1)
        x, y, size = rng.uniform(0, image.width), start + depth * (image.height - start), 3 + 4 * depth
        colour = (250, 240, 200) if rng.uniform() < 0.6 else (236, 204, 84)
        dab(draw, x, y, size, size * 0.7, 0, colour)
