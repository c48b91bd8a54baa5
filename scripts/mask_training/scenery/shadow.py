"""Shadow: the tree's shadow on the ground, dark leaf litter at its foot, and grass over it."""

from __future__ import annotations

import numpy as np
from PIL import Image as Pillow
from scipy.ndimage import gaussian_filter, uniform_filter1d

from scripts.mask_training.scenery.arrays import Field, Image, Rng, chance
from scripts.mask_training.scenery.canvas import Canvas, Stencil
from scripts.mask_training.scenery.noise import fractal
from scripts.mask_training.scenery.render import Pose
from scripts.mask_training.scenery.setting import Setting


def throw_shadow(canvas: Canvas, cover: Field, pose: Pose, setting: Setting, rng: Rng) -> None:
    """Darken the ground by the shadow of a tree that covers `cover` (h, w)."""
    ground = canvas.land * (np.arange(canvas.size)[:, None] > setting.horizon)
    if setting.sunny:
        shape = _lying(cover, pose, setting, rng)
        depth = rng.uniform(0.35, 0.7) * setting.light.strength
        canvas.tone(1 - depth * shape[..., None] * ground[..., None] * np.array([1.0, 0.97, 0.86], np.float32))
    under = Stencil(canvas.size)
    wide = pose.height * rng.uniform(0.08, 0.35)
    under.oval(pose.x, pose.y, wide, wide * rng.uniform(0.08, 0.2))
    soft = gaussian_filter(under.opacity(), (0.012 * canvas.size, 0.05 * canvas.size), truncate=1.5)
    canvas.tone(1 - rng.uniform(0.1, 0.5) * soft * ground)


def _lying(cover: Field, pose: Pose, setting: Setting, rng: Rng) -> Field:
    """`cover` laid down on the ground from the foot of the tree, away from the sun."""
    size = len(cover)
    right, away, up = setting.light.sun
    tilt = rng.uniform(0.16, 0.34)  # how flat the ground is seen
    flat = float(np.hypot(right, away))
    long = min(flat / max(up, 0.05), 3.0)  # of the shadow, in heights of the tree
    down, side = away / flat * long * tilt, -right / flat * long
    if abs(down) < 0.05:
        down = 0.05 if down >= 0 else -0.05
    # a picture row r of the shadow shows the row of the tree that is (r - foot) / down above the foot
    slope = -1 / down
    matrix = (1.0, side * slope, -side * slope * pose.y, 0.0, slope, pose.y - slope * pose.y)
    image = Pillow.fromarray(np.ascontiguousarray(cover, np.float32))
    laid = np.asarray(image.transform((size, size), Pillow.Transform.AFFINE, matrix, Pillow.Resampling.BILINEAR))
    # a crown is as deep as it is wide, its shadow not the thinner the lower one stands
    deep = cover.max(axis=0).sum() * tilt * rng.uniform(0.3, 0.8)
    wide = np.clip(uniform_filter1d(laid, max(2, int(deep)), axis=0) * 3, 0, 1)
    dapple = np.clip(1 + 0.35 * fractal(size, size, size * 0.02, rng, 2), 0.2, 1)
    soft: Field = gaussian_filter(np.maximum(wide * dapple, laid), size * rng.uniform(0.002, 0.008))
    return np.clip(soft, 0, 1)


def grow_grass(canvas: Canvas, behind: Image, pose: Pose, setting: Setting, rng: Rng) -> Field:
    """Paint grass and rising ground over the foot of the tree; return what they hide (h, w).

    `behind` (h, w, 3) is the picture without the tree.
    """
    size = canvas.size
    front = Canvas.blank(size)
    front.rgb[...] = canvas.rgb
    if chance(rng, 0.5):
        away = np.arange(size, dtype=np.float32)[:, None] - pose.y + size * rng.uniform(0.0, 0.012)
        rise = np.clip(away + 0.6 * rng.standard_normal((1, size), dtype=np.float32), 0, 1)
        front.lay(behind, rise * (np.abs(np.arange(size)[None] - pose.x) < 0.12 * pose.height))
    if setting.ground in ("lawn", "meadow", "dry"):
        count = int(rng.integers(10, 120))
        x = pose.x + rng.normal(0, 0.06 * pose.height, count)
        y = pose.y + rng.uniform(-0.2, 1.2, count) * size * 0.008
        near = np.clip(y.astype(int) + 3, 0, size - 1), np.clip(x.astype(int), 0, size - 1)
        colour = behind[near] * np.exp(rng.normal(0, 0.12, (count, 1)))
        long = size * rng.uniform(0.004, 0.014) * np.exp(rng.normal(0, 0.2, (count, 1)))
        half = np.hstack([long, np.full_like(long, size * 0.0022)])
        front.dabs(np.stack([x, y], axis=1), half, rng.normal(np.pi / 2, 0.35, count), np.clip(colour, 0, 1))
    canvas.rgb[...] = front.rgb
    return front.land
