"""Woods: hills, lines of trees, hedges and bushes behind and beside the tree, made of dabs of leaves."""

from __future__ import annotations

import numpy as np

from scripts.mask_training.scenery.arrays import Colour, Floats, Rng, chance, smoothstep, tinted
from scripts.mask_training.scenery.canvas import Canvas, Stencil
from scripts.mask_training.scenery.noise import fractal, line
from scripts.mask_training.scenery.palettes import drawn_palette
from scripts.mask_training.scenery.setting import Setting


def paint_hills(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """One to three ridges in the haze."""
    size, rows = canvas.size, np.arange(canvas.size, dtype=np.float32)[:, None]
    high = size * (rng.uniform(0.02, 0.1) if chance(rng, 0.8) else rng.uniform(0.1, 0.3))
    for k in range(int(rng.integers(1, 4))):
        ridge = setting.horizon - high / (1 + 0.7 * k) * (
            0.7 + 0.35 * line(size, size * rng.uniform(0.5, 2.0), rng, 4, 0.32)
        )
        kinds: tuple[Colour, ...] = ((0.30, 0.40, 0.26), (0.42, 0.42, 0.30), (0.35, 0.38, 0.40), (0.85, 0.88, 0.92))
        colour = (
            np.array(tinted(kinds[int(rng.integers(3 if setting.season != "snow" else 4))], rng, 0.15)) * setting.shade
        )
        air = np.clip(0.75 - 0.2 * k + setting.haze * 0.4, 0, 0.92)
        colour = colour + (np.array(setting.air) - colour) * air
        texture = 1 + fractal(size, size, size * 0.06, rng, 4) * 0.08 * (1 - air)
        canvas.lay(np.clip(colour * texture[..., None], 0, 1), np.clip(rows - ridge[None] + 0.5, 0, 1))


def paint_tree_line(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """Trees side by side at the horizon, low or as a wood that fills the background."""
    size = canvas.size
    high = size * (rng.uniform(0.03, 0.16) if chance(rng, 0.65) else rng.uniform(0.15, 0.75))
    cell = high * rng.uniform(0.4, 1.2) + 4
    top = setting.horizon - high * np.clip(0.75 + 0.28 * line(size, cell, rng, 4, 0.6), 0.15, 1.4)
    if chance(rng, 0.4):  # only a part of the horizon
        at, wide = rng.uniform(-0.1, 1.1) * size, rng.uniform(0.15, 0.6) * size
        gone = smoothstep(np.abs(np.arange(size, dtype=np.float32) - at), wide, wide * 1.3 + 2)
        top = top + gone * high * 1.6
    foot = np.full(size, setting.horizon + size * 0.01, np.float32)
    far = rng.uniform(0.1, 0.6) * (1 - min(high / size, 0.6))
    if chance(rng, 0.5 if setting.season in ("snow", "autumn", "bare") else 0.05):
        _bare_wood(canvas, setting, top, foot, far, rng)
    else:
        _leaves(canvas, setting, top, foot, far, size * rng.uniform(0.004, 0.012), rng)


def paint_bushes(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """Some bushes, or a hedge, on the ground behind the tree."""
    size = canvas.size
    if chance(rng, 0.35):
        _hedge(canvas, setting, rng)
        return
    for _ in range(int(rng.integers(1, 5))):
        t = rng.uniform(0.02, 0.5)
        foot = setting.horizon + t * (size - setting.horizon)
        bush(canvas, setting, rng.uniform(0, size), foot, size * rng.uniform(0.05, 0.2) * (0.4 + t), rng)


def bush(canvas: Canvas, setting: Setting, x: float, foot: float, high: float, rng: Rng) -> None:
    """A bush of `high` pixels at column `x` with its foot at row `foot`, and its shadow."""
    size = canvas.size
    half = high * rng.uniform(0.5, 1.3)
    columns = np.arange(size, dtype=np.float32)
    t = np.clip(1 - ((columns - x) / half) ** 2, 0, 1)
    top = foot - high * np.sqrt(t) * np.clip(0.85 + 0.15 * line(size, high * 0.5 + 3, rng, 3), 0.3, 1.4)
    bottom = np.where(t > 0, foot, top)
    _shade_under(canvas, x, foot, half, rng)
    _leaves(
        canvas,
        setting,
        top,
        bottom.astype(np.float32),
        rng.uniform(0, 0.25),
        max(1.2, high * rng.uniform(0.03, 0.09)),
        rng,
    )


def _hedge(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    size = canvas.size
    foot = setting.horizon + rng.uniform(0.0, 0.35) * (size - setting.horizon)
    high = size * rng.uniform(0.04, 0.22)
    slope = rng.normal(0, 0.04) * (np.arange(size, dtype=np.float32) - size / 2)
    top = foot - high * (1 + 0.04 * line(size, size * 0.05, rng, 3)) + slope
    _leaves(canvas, setting, top, foot + slope * 0.3, rng.uniform(0, 0.3), size * rng.uniform(0.006, 0.012), rng)


def _shade_under(canvas: Canvas, x: float, foot: float, half: float, rng: Rng) -> None:
    stencil = Stencil(canvas.size)
    stencil.oval(x + rng.normal(0, 0.3) * half, foot, half * 1.1, half * 0.15 + 1)
    canvas.tone(1 - rng.uniform(0.3, 0.6) * stencil.opacity())


def _leaves(canvas: Canvas, setting: Setting, top: Floats, bottom: Floats, far: float, leaf: float, rng: Rng) -> None:
    """Fill the band from row `top` to row `bottom` (w,) with dabs in clumps that are light above and dark below."""
    size = canvas.size
    tall = np.maximum(bottom - top, 0)
    area = float(tall.sum())
    if area < 4:
        return
    conifer = chance(rng, 0.25)
    season = setting.season if setting.season in ("autumn", "spring", "green") and chance(rng, 0.75) else "green"
    palette = drawn_palette(season, conifer, rng)
    mean = palette.mean(axis=0) * setting.shade
    rows = np.arange(size, dtype=np.float32)[:, None]
    inside = np.clip(rows - top[None] + 0.5, 0, 1) * np.clip(bottom[None] - rows + 0.5, 0, 1)
    air = np.array(setting.air)
    far = far * (0.4 + setting.haze)
    dark = mean * 0.42
    canvas.lay((dark + (air - dark) * far).astype(np.float32), inside)
    count = int(np.clip(area / (leaf * leaf) * rng.uniform(0.5, 1.1), 20, 3500))
    column = rng.choice(size, count, p=tall / area)
    height = rng.random(count)
    row = top[column] + tall[column] * height
    clump = fractal(size, size, max(leaf * rng.uniform(4, 9), 4), rng, 2, 0.5)
    kind = fractal(size, size, max(float(np.median(tall[tall > 0])), 8) * 0.8, rng, 2)
    at = np.clip(row.astype(int), 0, size - 1)
    lit = clump[at, column] - clump[np.minimum(at + max(2, int(leaf * 2)), size - 1), column]
    tone = np.exp(0.38 * np.clip(lit, -1.5, 1.5) * (0.5 + setting.light.strength) + rng.normal(0, 0.16, count)) * (
        1.15 - 0.4 * height
    )
    which = np.clip((0.5 + 0.3 * kind[at, column] + rng.normal(0, 0.15, count)) * len(palette), 0, len(palette) - 1)
    colour = palette[which.astype(int)] * setting.shade * (0.8 * tone)[:, None]
    colour = colour + (air - colour) * far
    if setting.season == "snow":
        snowy = rng.random(count) < 0.4 * rng.random()
        colour[snowy] = 0.85 * setting.shade
    half = leaf * np.exp(rng.normal(0, 0.3, (count, 2))) * np.array([0.9, 0.6])
    order = np.argsort(row)
    place = np.stack([column + rng.random(count), row], axis=1)
    canvas.dabs(place[order], half[order], rng.uniform(0, np.pi, count), np.clip(colour, 0, 1)[order], 0.9)


def _bare_wood(canvas: Canvas, setting: Setting, top: Floats, bottom: Floats, far: float, rng: Rng) -> None:
    """Grey and brown twigs of a wood in winter, denser towards the ground."""
    size = canvas.size
    rows = np.arange(size, dtype=np.float32)[:, None]
    t = np.clip((rows - top[None]) / np.maximum(bottom - top, 1)[None], 0, 1)
    streaks = fractal(size, size, max(size * 0.03, 3), rng, 4, 0.8, 0.25)
    below = np.clip(bottom[None] - rows + 0.5, 0, 1)
    opacity = smoothstep(t * 2.2 + 0.5 * streaks, 0.2, 1.4) * (t > 0) * below
    colour = np.array(
        tinted(((0.42, 0.36, 0.32), (0.36, 0.33, 0.33), (0.46, 0.40, 0.30))[int(rng.integers(3))], rng, 0.15)
    )
    colour = colour * setting.shade
    colour = colour + (np.array(setting.air) - colour) * far * 0.8
    canvas.lay(
        np.clip(colour * (1 + 0.22 * streaks[..., None]), 0, 1).astype(np.float32), opacity * rng.uniform(0.75, 1.0)
    )
