"""Groves: one rendered tree set many times along the horizon, near and far, as rows, groups and the edge of a wood."""

from __future__ import annotations

import numpy as np
from PIL import Image as Pillow

from scripts.mask_training.scenery.arrays import Floats, Rng, chance
from scripts.mask_training.scenery.canvas import Canvas
from scripts.mask_training.scenery.render import Pose, render
from scripts.mask_training.scenery.setting import Setting
from scripts.mask_training.scenery.trees import Tree, neighbour

LEAVES = 5000


def paint_grove(canvas: Canvas, tree: Tree, setting: Setting, rng: Rng) -> None:
    """Some dozen trees at the horizon, of one or two kinds; those of a kind are one tree in other sizes and tones."""
    size = canvas.size
    dense = chance(rng, 0.4)
    for _ in range(2 if chance(rng, 0.5) else 1):
        stamp = _stamp(neighbour(tree, rng, LEAVES), setting, int(size * 0.5), rng)
        tall = size * (rng.uniform(0.06, 0.22) if chance(rng, 0.7) else rng.uniform(0.2, 0.55))
        count = int(rng.integers(8, 22)) if dense else int(rng.integers(1, 8))
        middle, wide = rng.uniform(0, size), size * (rng.uniform(0.4, 1.2) if dense else rng.uniform(0.2, 0.7))
        deep = rng.beta(1, 4, count) * 0.35
        for t in np.sort(deep):
            foot = setting.horizon + t * (size - setting.horizon) + 0.3
            high = tall * (0.6 + t) * np.exp(rng.normal(0, 0.22))
            air = np.clip((0.15 + 0.5 * setting.haze) * (1 - 2 * t), 0, 0.7)
            _set(canvas, stamp, middle + rng.uniform(-0.5, 0.5) * wide, foot, high, float(air), setting, rng)


def _stamp(tree: Tree, setting: Setting, side: int, rng: Rng) -> Pillow.Image:
    """The tree alone as RGBA, its foot in the middle of the lower edge."""
    pose = Pose(side / 2, side * 0.99, side * 0.96, rng.uniform(0, 2 * np.pi))
    layer = render(tree.model, pose, tree.look, setting.light, side, 1, rng)
    picture = np.dstack([layer.rgb, layer.cover])
    return Pillow.fromarray((np.clip(picture, 0, 1) * 255).astype(np.uint8), "RGBA")


def _set(
    canvas: Canvas, stamp: Pillow.Image, x: float, foot: float, high: float, air: float, setting: Setting, rng: Rng
) -> None:
    size = canvas.size
    tall, wide = max(3, round(high)), max(3, round(high * np.exp(rng.normal(0.15, 0.2))))
    small = stamp.resize((wide, tall), Pillow.Resampling.BOX)
    if chance(rng, 0.5):
        small = small.transpose(Pillow.Transpose.FLIP_LEFT_RIGHT)
    left, top = round(x - wide / 2), round(foot) - tall
    a, b, c, d = max(left, 0), max(top, 0), min(left + wide, size), min(top + tall, size)
    if c <= a or d <= b:
        return
    part: Floats = np.asarray(small, np.float32)[b - top : d - top, a - left : c - left] / 255
    opacity = part[..., 3]
    colour = part[..., :3] * np.exp(rng.normal(0, 0.1)) * np.exp(rng.normal(0, 0.04, 3))
    # means over pixels of the air around it are dark: opacity restores them
    colour = colour + (np.array(setting.air) - colour) * air
    under = canvas.paint[b:d, a:c]
    under[..., :3] += (colour - under[..., :3]) * opacity[..., None]
    under[..., 3] = np.maximum(under[..., 3], opacity)
