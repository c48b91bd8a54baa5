"""Conifer: whorls of drooping branches on a straight trunk, painted needle by needle from the far side to the near."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw

from painting.bark import paint_limb
from painting.canvas import tone

NEEDLES = [(0.0, (14, 30, 24)), (0.35, (32, 66, 42)), (0.7, (84, 124, 62)), (1.0, (172, 192, 104))]
FAR, MIDDLE, NEAR = 0, 1, 2


@dataclass(frozen=True)
class Bough:
    """A branch: height on the tree 0..1, direction seen from above in radians (0 is right), length in pixels."""

    height: float
    azimuth: float
    length: float

    @property
    def nearness(self) -> float:
        """1 straight towards the viewer, -1 straight away."""
        return math.sin(self.azimuth)

    @property
    def layer(self) -> int:
        """FAR, MIDDLE or NEAR: the order of painting."""
        return int(np.digitize(self.nearness, (-0.35, 0.35)))


def paint_conifer(layer: Image.Image, x: float, foot: float, tall: float, rng: np.random.Generator) -> None:
    """Paint a conifer `tall` pixels high with its foot at (x, foot) on a transparent layer."""
    draw = ImageDraw.Draw(layer)
    boughs = _boughs(tall, rng)
    trunk = [
        (x + math.sin(3 * t) * 0.004 * tall, foot - t * 0.97 * tall, 0.019 * tall * (1 - t) + 2)
        for t in np.linspace(0, 1, 40)
    ]
    for part in (FAR, MIDDLE, NEAR):
        if part == MIDDLE:
            paint_limb(draw, trunk, rng)
            _fill_heart(draw, x, foot, tall, rng)
        for bough in sorted((b for b in boughs if b.layer == part), key=lambda b: b.height):
            _paint_bough(draw, bough, x, foot - bough.height * tall, rng)
    for up in np.linspace(0.95, 1.0, 70):  # the leader
        _needle(draw, x, foot - up * tall, -math.pi / 2 + rng.normal(0, 0.6), 14, 0.62, rng)


def _boughs(tall: float, rng: np.random.Generator) -> list[Bough]:
    boughs = []
    for index, height in enumerate(np.linspace(0.13, 0.985, 32)):
        # every third whorl is a strong year: the outline steps
        vigour = (1.06, 0.92, 0.80)[index % 3] * rng.uniform(0.92, 1.08)
        spread = 0.31 * tall * (1 - height) ** 0.94 * vigour + 0.004 * tall
        turn = rng.uniform(0, 2 * math.pi)
        for azimuth in turn + np.arange(12) * 2 * math.pi / 12 + rng.normal(0, 0.16, 12):
            place = float(height + rng.normal(0, 0.008))
            boughs.append(Bough(place, float(azimuth), float(spread * rng.uniform(0.7, 1.08))))
    return boughs


def _fill_heart(draw: ImageDraw.ImageDraw, x: float, foot: float, tall: float, rng: np.random.Generator) -> None:
    """Dark inner needles, so that the sky shows only near the rim."""
    for _ in range(9000):
        up = 0.165 + 0.79 * rng.uniform() ** 1.4
        reach = 0.17 * tall * (1 - up) ** 0.9
        angle = rng.uniform(0, 2 * math.pi)
        _needle(
            draw,
            x + np.clip(rng.normal(0, 0.45), -0.9, 0.9) * reach,
            foot - up * tall,
            angle,
            20,
            rng.uniform(0.0, 0.3),
            rng,
        )


def _paint_bough(draw: ImageDraw.ImageDraw, bough: Bough, x: float, y: float, rng: np.random.Generator) -> None:
    """Twigs to both sides of the branch and needles on the twigs; lit from the upper left, dark at the trunk."""
    sideways = math.cos(bough.azimuth)
    droop = 0.32 + 0.18 * (1 - bough.height) + rng.normal(0, 0.04)
    side_light = 0.5 - 0.38 * sideways + 0.12 * bough.nearness
    for s in np.arange(0.12, 1.0, 7.0 / max(bough.length, 20)):
        # out, down by its weight, and up again at the tip
        down = bough.length * (droop * s - 0.24 * s**3 + 0.14 * bough.nearness * s)
        u, v = x + sideways * bough.length * s, y + down - 0.06 * bough.length
        light = (
            (0.15 + 0.85 * s**1.2) * side_light
            + (0.10 if bough.layer == NEAR else 0)
            - (0.16 if bough.layer == FAR else 0)
        )
        heading = math.atan2(0.35, sideways if abs(sideways) > 0.15 else 0.15 * (1 if sideways >= 0 else -1))
        twig = (0.16 * bough.length * (1.15 - s) + 4 + min(5, 0.1 * bough.length)) * rng.uniform(0.7, 1.2)
        for side in (-1, 1):
            _paint_twig(
                draw, u, v, heading + side * rng.uniform(0.35, 1.0), twig, light - 0.14 * side * np.sign(sideways), rng
            )


def _paint_twig(
    draw: ImageDraw.ImageDraw, x: float, y: float, turn: float, long: float, light: float, rng: np.random.Generator
) -> None:
    for along in np.arange(0, long, 6):
        u, v = x + math.cos(turn) * along, y + math.sin(turn) * along * 0.8
        _needle(draw, u, v, turn + rng.normal(0, 0.55), 13, light + rng.normal(0, 0.10), rng)


def _needle(
    draw: ImageDraw.ImageDraw, x: float, y: float, turn: float, long: float, light: float, rng: np.random.Generator
) -> None:
    reach = long * rng.uniform(0.6, 1.2)
    end = (x + math.cos(turn) * reach, y + math.sin(turn) * reach)
    draw.line((x, y, *end), fill=(*tone(NEEDLES, min(max(light, 0), 1), rng, 0.05), 255), width=3)
