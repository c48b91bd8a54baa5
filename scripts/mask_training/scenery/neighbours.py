"""Neighbours: trees behind and beside the one that is meant, which are background however large they are."""

from __future__ import annotations

import numpy as np

from scripts.mask_training.scenery.arrays import Field, Rng, chance
from scripts.mask_training.scenery.canvas import Canvas
from scripts.mask_training.scenery.render import Pose, render
from scripts.mask_training.scenery.setting import Setting
from scripts.mask_training.scenery.trees import Tree, neighbour

LEAVES = 6000


def paint_neighbours(canvas: Canvas, tree: Tree, pose: Pose, setting: Setting, rng: Rng) -> None:
    """Up to three trees somewhere behind, or a group of tall ones close behind `tree`, which stands at `pose`."""
    if chance(rng, 0.14):
        places = [_close(canvas.size, pose, setting, rng) for _ in range(int(rng.integers(1, 4)))]
    else:
        count = int(rng.choice([0, 1, 2, 3], p=(0.4, 0.32, 0.18, 0.10)))
        places = [_somewhere(canvas.size, pose, setting, rng) for _ in range(count)]
    for place in sorted(places, key=lambda one: one.y):
        other = neighbour(tree, rng, LEAVES)
        layer = render(other.model, place, other.look, setting.light, canvas.size, 1, rng)
        near = (place.y - setting.horizon) / max(pose.y - setting.horizon, 1)
        far = np.float32(np.clip(setting.haze * (1 - near) * 0.8, 0, 1))
        canvas.tone(1 - 0.35 * _foot_shade(canvas.size, place))
        canvas.lay(layer.rgb + (np.array(setting.air, np.float32) - layer.rgb) * far, layer.cover)


def _somewhere(size: int, pose: Pose, setting: Setting, rng: Rng) -> Pose:
    """Place of a tree that is smaller, or at the border of the picture."""
    t = rng.uniform(0.0, 0.85)
    foot = setting.horizon + t * (pose.y - setting.horizon)
    height = pose.height * rng.uniform(0.15, 0.75) * (0.35 + 0.65 * t)
    side = float(rng.choice([-1, 1]))
    # a tree as large as the one that is meant stands well beside it
    x = pose.x + side * rng.uniform(0.12 if height < 0.55 * pose.height else 0.33, 0.65) * size
    if chance(rng, 0.3):
        height, x = pose.height * rng.uniform(0.8, 1.3), pose.x + side * rng.uniform(0.45, 0.68) * size
    return Pose(x, foot, height, rng.uniform(0, 2 * np.pi), 0.0, rng.normal(0, 0.03))


def _close(size: int, pose: Pose, setting: Setting, rng: Rng) -> Pose:
    """Place of a tree close behind, as high or higher, partly hidden by the one that is meant."""
    foot = setting.horizon + rng.uniform(0.2, 0.8) * (pose.y - setting.horizon)
    height = pose.height * rng.uniform(0.6, 1.5)
    x = pose.x + float(rng.choice([-1, 1])) * rng.uniform(0.18, 0.5) * size
    return Pose(
        x, foot, height, rng.uniform(0, 2 * np.pi), 0.0, rng.normal(0, 0.03), float(np.exp(rng.normal(0.2, 0.15)))
    )


def _foot_shade(size: int, pose: Pose) -> Field:
    """Dark ellipse (size, size) on the ground under a tree."""
    y, x = np.mgrid[:size, :size].astype(np.float32)
    far = ((x - pose.x) / (0.3 * pose.height)) ** 2 + ((y - pose.y) / (0.03 * pose.height + 1)) ** 2
    shade: Field = np.exp(-far)
    return shade
