"""Broadleaf tree: a forking skeleton in space that carries clusters of leaf dabs, lit from the upper left."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from painting.bark import paint_limb
from painting.canvas import Colour, dab, tone

SUN = np.array([-0.52, 0.68, 0.52])

Vector = NDArray[np.float64]
"""(3,) x to the right, y up, z to the viewer, in pixels."""


@dataclass(frozen=True)
class Species:
    """Shape and colours; lengths are shares of the tree's height.

    `leader` is how far the first branch of a fork turns aside compared with the others: 0 gives one straight axis;
    `wide` is the width of the whole tree.
    """

    trunk: float
    girth: float
    first_limb: float
    shrink: float
    opening: float
    leader: float
    lift: float
    wide: float
    cluster: float
    leaves: int
    leaf: float
    greens: tuple[tuple[float, Colour], ...]


@dataclass(frozen=True)
class Limb:
    """One unforked piece: points (n, 3) and radii (n,) in pixels; depth 0 is the trunk."""

    points: NDArray[np.float64]
    radii: NDArray[np.float64]
    depth: int


def paint_broadleaf(
    layer: Image.Image, species: Species, x: float, foot: float, tall: float, rng: np.random.Generator
) -> None:
    """Paint a tree about `tall` pixels high with its foot at (x, foot) on a transparent layer."""
    limbs: list[Limb] = []
    _grow(limbs, species, np.zeros(3), np.array([rng.normal(0, 0.03), 1.0, 0.0]), species.trunk, species.girth, 0, rng)
    tips = np.array([limb.points[-1] for limb in limbs if limb.depth >= 4])
    tall_scale = tall / (tips[:, 1].max() + 0.8 * species.cluster)
    # a tree wider than its species is squeezed, as seen from a side where it is narrow
    wide_scale = min(tall_scale, tall * species.wide / (np.ptp(tips[:, 0]) + 1.6 * species.cluster))
    stretch = np.array([wide_scale, tall_scale, wide_scale])
    tips, scale = tips * stretch, tall_scale
    draw = ImageDraw.Draw(layer)
    heart = np.array([tips[:, 0].mean(), tips[:, 1].mean(), 0.0])
    behind, before = tips[tips[:, 2] < 0], tips[tips[:, 2] >= 0]
    _paint_leaves(draw, species, behind, heart, (x, foot, scale), -0.16, rng)
    for limb in sorted(limbs, key=lambda limb: -limb.depth):
        points = limb.points * stretch
        path = [(x + p[0], foot - p[1], max(1.0, r * scale)) for p, r in zip(points, limb.radii, strict=True)]
        paint_limb(draw, path, rng, dim=0.0 if limb.depth == 0 else 0.12)
    _paint_leaves(draw, species, before, heart, (x, foot, scale), 0.0, rng)


def _grow(
    limbs: list[Limb],
    species: Species,
    start: Vector,
    heading: Vector,
    length: float,
    radius: float,
    depth: int,
    rng: np.random.Generator,
) -> None:
    points, way = [start], heading
    for _ in range(8):
        way = way + rng.normal(0, 0.07 if depth else 0.02, 3) + (0.0, species.lift if depth else 0.0, 0.0)
        way = way / np.linalg.norm(way)
        points.append(points[-1] + way * length / 8)
    along = np.linspace(0, 1, 9)
    # the foot of the trunk widens into its roots
    flare = 0.9 * np.exp(-along * 9) if depth == 0 else 0.0
    limbs.append(Limb(np.array(points), radius * (1 - 0.3 * along + flare), depth))
    if depth == 6:
        return
    count = 4 if depth == 0 else int(rng.integers(2, 4))
    turn = rng.uniform(0, 2 * math.pi)
    for index in range(count):
        azimuth = turn + 2 * math.pi * index / count + rng.normal(0, 0.3)
        turned = species.leader if index == 0 else rng.uniform(0.75, 1.35)
        child = _tilt(way, species.opening * turned, azimuth)
        long = (species.first_limb if depth == 0 else length * species.shrink) * rng.uniform(0.8, 1.15)
        _grow(limbs, species, points[-1], child, long, 0.7 * radius * count**-0.42 * 1.25, depth + 1, rng)


def _tilt(way: Vector, angle: float, azimuth: float) -> Vector:
    """`way` turned by `angle` radians towards `azimuth` around it."""
    aside = np.cross(way, (0.0, 0.0, 1.0))
    aside /= np.linalg.norm(aside) + 1e-9
    third = np.cross(way, aside)
    around = math.cos(azimuth) * aside + math.sin(azimuth) * third
    return np.asarray(math.cos(angle) * way + math.sin(angle) * around)


def _paint_leaves(
    draw: ImageDraw.ImageDraw,
    species: Species,
    tips: NDArray[np.float64],
    heart: Vector,
    frame: tuple[float, float, float],
    shade: float,
    rng: np.random.Generator,
) -> None:
    """Clusters from far to near; a leaf is light where its cluster and the crown face the sun."""
    x, foot, scale = frame
    ball = species.cluster * scale
    crown = np.abs(tips - heart).max(axis=0) + ball
    for tip in tips[np.argsort(tips[:, 2])]:
        outward = (tip - heart) / crown
        # leaves low in a cluster first: the sunlit ones lie on top
        offsets = _ball(species.leaves, rng) * (1.0, 0.75, 1.0)
        for offset in offsets[np.argsort(offsets @ SUN)]:
            place = tip + offset * ball
            light = 0.40 + shade + 0.27 * float(offset @ SUN) + 0.34 * float(outward @ SUN) + rng.normal(0, 0.07)
            colour = tone(list(species.greens), min(max(light, 0), 1), rng, 0.05)
            size = species.leaf * scale * rng.uniform(0.7, 1.3)
            dab(draw, x + place[0], foot - place[1], size, size * 0.62, rng.uniform(0, math.pi), (*colour, 255))


def _ball(count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """(count, 3) points within a unit ball, denser in the middle."""
    way = rng.normal(0, 1, (count, 3))
    return np.asarray(way / np.linalg.norm(way, axis=1, keepdims=True) * rng.uniform(0, 1, (count, 1)) ** 0.5)
