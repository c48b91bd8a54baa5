"""Broadleaf tree: a crown of leafy lobes on a grown skeleton, lit from the upper left."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw

from painting.bark import paint_limb
from painting.canvas import Colour, dab, tone
from painting.skeleton import Points, grow

SUN = np.array([-0.52, 0.68, 0.52])
GOLDEN_ANGLE = math.pi * (3 - math.sqrt(5))


@dataclass(frozen=True)
class Species:
    """Shape in tree heights, and colours: the crown is an ellipsoid of `wide` and `high` half axes, set with lobes."""

    bare: float
    girth: float
    middle: float
    wide: float
    high: float
    lobes: int
    lobe: float
    leaves: int
    leaf: float
    greens: tuple[tuple[float, Colour], ...]


def paint_broadleaf(
    layer: Image.Image, species: Species, x: float, foot: float, tall: float, rng: np.random.Generator
) -> None:
    """Paint a tree about `tall` pixels high with its foot at (x, foot) on a transparent layer."""
    centres, sizes = _lobes(species, rng)
    places = np.vstack([c + s * 0.7 * _ball(26, rng) for c, s in zip(centres, sizes, strict=True)])
    limbs = grow(places, species.bare, species.girth, rng)
    draw = ImageDraw.Draw(layer)
    order = np.argsort(centres[:, 2])
    far = int((centres[:, 2] < 0).sum())
    for lobe in order[:far]:
        _paint_lobe(draw, species, centres[lobe], sizes[lobe], (x, foot, tall), rng)
    for limb in reversed(limbs):
        path = [(x + p[0] * tall, foot - p[1] * tall, r * tall) for p, r in zip(limb.points, limb.radii, strict=True)]
        paint_limb(draw, path, rng, dim=0.0 if limb is limbs[0] else 0.10)
    for lobe in order[far:]:
        _paint_lobe(draw, species, centres[lobe], sizes[lobe], (x, foot, tall), rng)


def _lobes(species: Species, rng: np.random.Generator) -> tuple[Points, Points]:
    """Centres (n, 3) spread evenly over the crown, some inside, and radii (n,)."""
    index = np.arange(species.lobes) + 0.5
    up = 1 - 1.75 * index / species.lobes
    turn = index * GOLDEN_ANGLE + rng.uniform(0, 6)
    ring = np.sqrt(1 - up**2)
    shell = np.stack((ring * np.cos(turn), up, ring * np.sin(turn)), axis=1)
    shell *= rng.uniform(0.52, 1.0, (species.lobes, 1)) ** 0.5
    half = np.array([species.wide, species.high, species.wide]) - species.lobe
    centres = shell * half + (0, species.middle, 0) + rng.normal(0, 0.012, shell.shape)
    return centres, species.lobe * rng.uniform(0.65, 1.25, species.lobes)


def _paint_lobe(
    draw: ImageDraw.ImageDraw,
    species: Species,
    centre: Points,
    size: float,
    frame: tuple[float, float, float],
    rng: np.random.Generator,
) -> None:
    """Leaves of one lobe; a leaf is light where the lobe and the whole crown face the sun."""
    x, foot, tall = frame
    crown = np.array([species.wide, species.high, species.wide])
    outward = (centre - (0, species.middle, 0)) / crown
    offsets = _ball(species.leaves, rng)
    # leaves away from the sun first: the lit ones lie on top
    for offset in offsets[np.argsort(offsets @ SUN)]:
        place = centre + offset * size * (1.08, 0.86, 1.0)
        light = 0.40 + 0.40 * float(offset @ SUN) + 0.24 * float(outward @ SUN) + rng.normal(0, 0.06)
        colour = tone(list(species.greens), min(max(light, 0), 1), rng, 0.05)
        long = species.leaf * tall * rng.uniform(0.7, 1.3)
        dab(
            draw,
            x + place[0] * tall,
            foot - place[1] * tall,
            long,
            0.62 * long,
            rng.uniform(0, math.pi),
            (*colour, 255),
        )


def _ball(count: int, rng: np.random.Generator) -> Points:
    """(count, 3) points within a unit ball, evenly but for a frayed rim."""
    way = rng.normal(0, 1, (count, 3))
    reach = rng.uniform(0, 1, (count, 1)) ** 0.4 * rng.uniform(0.85, 1.12, (count, 1))
    return np.asarray(way / np.linalg.norm(way, axis=1, keepdims=True) * reach)
