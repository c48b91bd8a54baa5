"""Pencil: a line drawing of a tree, each line drawn twice by a hand that is not quite steady."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from painting.canvas import OVERSAMPLING, fractal

PAPER = (252, 251, 247)
GRAPHITE = 62

Line = NDArray[np.float64]
"""(n, 2) x, y in painting pixels."""


def draw_tree(width: int, height: int, rng: np.random.Generator) -> Image.Image:
    """Sketch of a round-crowned tree, `width` x `height` final pixels."""
    image = Image.new("RGB", (width * OVERSAMPLING, height * OVERSAMPLING), PAPER)
    draw = ImageDraw.Draw(image)
    middle, foot = image.width / 2, 0.93 * image.height
    crown = _crown(middle, 0.39 * image.height, 0.38 * image.width, 0.30 * image.height, rng)
    _stroke(draw, np.vstack((crown, crown[:6])), 5, rng)
    _stroke(draw, np.vstack((crown, crown[:6])) + rng.normal(0, 2, (len(crown) + 6, 2)), 3, rng)
    _trunk(draw, middle, foot, 0.68 * image.height, 0.045 * image.width, rng)
    _leaves(draw, middle, 0.39 * image.height, 0.33 * image.width, 0.25 * image.height, rng)
    return _grain(image, rng)


def _crown(x: float, y: float, wide: float, tall: float, rng: np.random.Generator) -> Line:
    """Closed outline of scallops around an uneven ellipse."""
    lobes = 19
    turns = np.linspace(0, 2 * math.pi, 12 * lobes, endpoint=False)
    uneven = 1 + 0.07 * np.sin(2 * turns + 0.6) + 0.05 * np.sin(3 * turns + 2) + 0.03 * np.sin(5 * turns)
    phase = turns * lobes / 2 + 0.5 * np.sin(3 * turns) + rng.uniform(0, 1)
    scallop = 1 + 0.085 * np.abs(np.sin(phase)) - 0.03
    return np.stack((x + wide * uneven * scallop * np.cos(turns), y + tall * uneven * scallop * np.sin(turns)), axis=1)


def _trunk(draw: ImageDraw.ImageDraw, x: float, foot: float, top: float, half: float, rng: np.random.Generator) -> None:
    rise = np.linspace(0, 1, 40)
    y = foot + (top - 20 - foot) * rise
    width = half * (1 - 0.28 * rise + 0.8 * np.exp(-rise * 9))
    lean = 6 * np.sin(2.2 * rise)
    for side in (-1, 1):
        edge = np.stack((x + lean + side * width, y), axis=1)
        _stroke(draw, edge, 5, rng)
        _stroke(draw, edge + rng.normal(0, 1.5, edge.shape), 3, rng)
    ground = np.stack(
        (np.linspace(x - 1.8 * half, x + 1.8 * half, 20), foot + 7 * np.sin(np.linspace(0, math.pi, 20))), axis=1
    )
    _stroke(draw, ground, 4, rng)
    for _ in range(46):  # bark, denser on the shaded side
        place = 1 - 1.8 * rng.uniform() ** 2
        start, long = int(rng.integers(3, 30)), int(rng.integers(3, 9))
        piece = slice(start, start + long)
        _stroke(draw, np.stack((x + lean[piece] + 0.86 * place * width[piece], y[piece]), axis=1), 2, rng)


def _leaves(draw: ImageDraw.ImageDraw, x: float, y: float, wide: float, tall: float, rng: np.random.Generator) -> None:
    """Rows of small arcs like bundles of leaves, and hatching on the side away from the light."""
    for _ in range(34):
        angle, reach = rng.uniform(0, 2 * math.pi), math.sqrt(rng.uniform(0, 0.9))
        u, v, size = x + wide * reach * math.cos(angle), y + tall * reach * math.sin(angle), rng.uniform(20, 36)
        lean, bumps = rng.normal(0, 0.35), int(rng.integers(2, 5))
        turns = np.linspace(1.05 * math.pi, 1.95 * math.pi, 10)
        bundle = [
            np.stack((size * (i + 0.5 * np.cos(turns)), 0.55 * size * np.sin(turns)), axis=1) for i in range(bumps)
        ]
        line = np.vstack(bundle) @ np.array([[math.cos(lean), math.sin(lean)], [-math.sin(lean), math.cos(lean)]])
        _stroke(draw, line + np.array([u, v]), 3, rng)
    for _ in range(210):
        angle, reach = rng.uniform(-0.6, 1.9), rng.uniform(0.6, 0.99)
        u, v, long = x + wide * reach * math.cos(angle), y + tall * reach * math.sin(angle), rng.uniform(26, 60)
        steps = np.linspace(0, 1, 8)
        _stroke(draw, np.stack((u - 0.5 * long * steps, v + 0.62 * long * steps), axis=1), 2, rng)


def _stroke(draw: ImageDraw.ImageDraw, line: Line, width: int, rng: np.random.Generator) -> None:
    """A line whose darkness follows the pressure of the hand."""
    wobble = np.cumsum(rng.normal(0, 0.35, line.shape), axis=0)
    shaky = line + wobble - np.linspace(0, 1, len(line))[:, None] * wobble[-1]
    pressure = GRAPHITE + 16 * np.sin(np.arange(len(line)) * 0.23 + rng.uniform(0, 6)) + (24 if width <= 2 else 0)
    for (start, end), grey in zip(pairwise(shaky), pressure[:-1], strict=True):
        draw.line((*start, *end), fill=(int(grey), int(grey), int(grey + 3)), width=width)
        radius = width / 2 - 0.5
        draw.ellipse(
            (end[0] - radius, end[1] - radius, end[0] + radius, end[1] + radius),
            fill=(int(grey), int(grey), int(grey + 3)),
        )


def _grain(image: Image.Image, rng: np.random.Generator) -> Image.Image:
    """The tooth of the paper breaks the graphite a little."""
    pixels = np.asarray(image).astype(float)
    tooth = fractal(pixels.shape[:2], (260, 200), 2, rng)[..., None]
    paper = np.array(PAPER, dtype=float)
    lifted = pixels + (paper - pixels) * np.clip(0.16 * tooth, 0, 0.3)
    return Image.fromarray(np.clip(lifted, 0, 255).astype(np.uint8))
