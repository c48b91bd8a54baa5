"""Buildings: houses, halls and walls with windows, doors and roofs."""

from __future__ import annotations

import numpy as np

from scripts.mask_training.scenery.arrays import Colour, Rng, chance, tinted
from scripts.mask_training.scenery.canvas import Canvas, Stencil
from scripts.mask_training.scenery.noise import fractal
from scripts.mask_training.scenery.setting import Setting

WALLS: tuple[Colour, ...] = (
    (0.62, 0.38, 0.30), (0.86, 0.82, 0.74), (0.75, 0.72, 0.68), (0.90, 0.89, 0.87), (0.60, 0.56, 0.50),
    (0.50, 0.52, 0.55), (0.80, 0.68, 0.48), (0.42, 0.32, 0.26),
)  # fmt: skip
ROOFS: tuple[Colour, ...] = ((0.40, 0.25, 0.20), (0.32, 0.32, 0.34), (0.55, 0.30, 0.22), (0.25, 0.23, 0.22))
GLASS: tuple[Colour, ...] = ((0.16, 0.19, 0.22), (0.35, 0.42, 0.48), (0.60, 0.68, 0.75), (0.10, 0.10, 0.11))


def paint_buildings(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """One to three buildings at the horizon, or one wall that fills the background."""
    size = canvas.size
    if chance(rng, 0.2):
        _house(
            canvas, setting, -0.1 * size, setting.horizon + 0.02 * size, 1.2 * size, size * rng.uniform(0.3, 1.0), rng
        )
        return
    for _ in range(int(rng.integers(1, 4))):
        wide, tall = size * rng.uniform(0.1, 0.6), size * rng.uniform(0.05, 0.45)
        foot = setting.horizon + size * rng.uniform(0, 0.03)
        _house(canvas, setting, rng.uniform(-0.2, 0.95) * size, foot, wide, tall, rng)


def paint_wall(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """A low wall across the picture."""
    size = canvas.size
    foot = setting.horizon + rng.uniform(0.02, 0.4) * (size - setting.horizon)
    high, slope = size * rng.uniform(0.02, 0.12), rng.normal(0, 0.03) * size
    stencil = Stencil(size)
    stencil.polygon([(-1, foot - high), (size + 1, foot - high + slope), (size + 1, foot + slope * 1.1), (-1, foot)])
    canvas.lay(_masonry(canvas, setting, WALLS, rng), stencil.opacity())


def _house(canvas: Canvas, setting: Setting, left: float, foot: float, wide: float, tall: float, rng: Rng) -> None:
    size, top, right = canvas.size, foot - tall, left + wide
    wall = Stencil(size)
    wall.box(left, top, right, foot)
    canvas.lay(_masonry(canvas, setting, WALLS, rng), wall.opacity())
    if chance(rng, 0.65):
        roof, rise, over = Stencil(size), tall * rng.uniform(0.15, 0.7), wide * 0.03
        inset = wide * (0.5 if chance(rng, 0.4) else rng.uniform(0.0, 0.3))
        roof.polygon([(left - over, top), (left + inset, top - rise), (right - inset, top - rise), (right + over, top)])
        canvas.lay(_masonry(canvas, setting, ROOFS, rng), roof.opacity())
    else:
        ledge = Stencil(size)
        ledge.box(left - 1, top, right + 1, top + max(1.0, tall * 0.04))
        canvas.tone(1 - 0.3 * ledge.opacity())
    _windows(canvas, setting, left, top, wide, tall, rng)


def _windows(canvas: Canvas, setting: Setting, left: float, top: float, wide: float, tall: float, rng: Rng) -> None:
    size = canvas.size
    floors = max(1, round(tall / (size * rng.uniform(0.06, 0.14))))
    columns = max(1, round(wide / (size * rng.uniform(0.04, 0.12))))
    part, high = rng.uniform(0.35, 0.75), rng.uniform(0.4, 0.75)
    glass, frame = Stencil(size), Stencil(size)
    dx, dy = wide / columns, tall / floors
    rim = max(0.4, 0.08 * dx)
    for floor in range(floors):
        for column in range(columns):
            if chance(rng, 0.08):
                continue
            x, y = left + (column + 0.5 - part / 2) * dx, top + (floor + 0.6 - high / 2) * dy
            frame.box(x - rim, y - rim, x + part * dx + rim, y + high * dy + rim)
            glass.box(x, y, x + part * dx, y + high * dy, int(rng.integers(150, 256)))
    if chance(rng, 0.5):
        canvas.lay(tuple(np.array([0.88, 0.87, 0.85]) * setting.shade), frame.opacity())
    canvas.lay(tuple(np.array(tinted(GLASS[int(rng.integers(4))], rng, 0.2)) * setting.shade), glass.opacity())


def _masonry(canvas: Canvas, setting: Setting, kinds: tuple[Colour, ...], rng: Rng) -> np.ndarray:
    """Colours (h, w, 3) with courses of bricks or boards, and stains."""
    size = canvas.size
    colour = np.array(tinted(kinds[int(rng.integers(len(kinds)))], rng, 0.12)) * setting.shade * rng.uniform(0.6, 1.05)
    air = setting.haze * 0.4
    colour = colour + (np.array(setting.air) - colour) * air
    tone = 1 + 0.05 * fractal(size, size, size * rng.uniform(0.05, 0.5), rng, 5, 0.7)
    if chance(rng, 0.5):
        step = size * rng.uniform(0.008, 0.03)
        lines = (
            (np.arange(size, dtype=np.float32) % step < 1)[:, None]
            if chance(rng, 0.7)
            else (np.arange(size) % step < 1)[None]
        )
        tone = tone * (1 - rng.uniform(0.05, 0.2) * lines)
    painted: np.ndarray = np.clip(colour * tone[..., None], 0, 1).astype(np.float32)
    return painted
