"""Things that are no tree: poles, lamps, wires, fences, rails, cars, benches, signs, stones, people, mulch."""

from __future__ import annotations

import numpy as np

from scripts.mask_training.scenery.arrays import Colour, Rng, chance, tinted
from scripts.mask_training.scenery.canvas import Canvas, Stencil
from scripts.mask_training.scenery.noise import fractal
from scripts.mask_training.scenery.setting import Setting

GREYS: tuple[Colour, ...] = (
    (0.5, 0.5, 0.5),
    (0.25, 0.25, 0.27),
    (0.42, 0.33, 0.26),
    (0.8, 0.8, 0.8),
    (0.35, 0.38, 0.35),
)
PAINTS: tuple[Colour, ...] = (
    (0.85, 0.86, 0.88), (0.15, 0.16, 0.18), (0.6, 0.1, 0.1), (0.15, 0.25, 0.5), (0.45, 0.46, 0.48), (0.75, 0.7, 0.3),
)  # fmt: skip


def paint_things(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """A few things between the horizon and the tree."""
    kinds = {
        _pole: 0.22, _fence: 0.16, _rail: 0.1, _car: 0.12, _bench: 0.06, _sign: 0.1, _stones: 0.08, _person: 0.07,
        _wires: 0.07,
    }  # fmt: skip
    for paint, share in kinds.items():
        if chance(rng, share):
            for _ in range(1 if chance(rng, 0.7) else int(rng.integers(2, 5))):
                paint(canvas, setting, rng)


def paint_mulch(canvas: Canvas, setting: Setting, x: float, y: float, radius: float, rng: Rng) -> None:
    """A ring of mulch, soil or gravel around the foot of the tree."""
    size = canvas.size
    stencil = Stencil(size)
    stencil.oval(x, y, radius, radius * rng.uniform(0.12, 0.3))
    kinds: tuple[Colour, ...] = (
        (0.36, 0.24, 0.17),
        (0.46, 0.34, 0.26),
        (0.60, 0.54, 0.46),
        (0.28, 0.22, 0.18),
        (0.55, 0.32, 0.2),
    )
    colour = np.array(tinted(kinds[int(rng.integers(5))], rng, 0.12)) * setting.shade
    rough = np.exp(0.2 * fractal(size, size, 3, rng, 2, 0.9))
    soft = np.clip(stencil.opacity() * (1 + 0.3 * fractal(size, size, 5, rng, 2)), 0, 1)
    canvas.lay(np.clip(colour * rough[..., None], 0, 1).astype(np.float32), soft)


def _lay(canvas: Canvas, stencil: Stencil, kinds: tuple[Colour, ...], setting: Setting, rng: Rng) -> None:
    colour = np.array(tinted(kinds[int(rng.integers(len(kinds)))], rng, 0.15)) * setting.shade
    side = 1 + rng.normal(0, 0.15) * np.linspace(-1, 1, canvas.size)[None, :, None]
    canvas.lay(np.clip(colour * side * np.ones((canvas.size, 1, 1)), 0, 1).astype(np.float32), stencil.opacity())


def _foot(canvas: Canvas, setting: Setting, rng: Rng) -> tuple[float, float]:
    """Row of the foot of a thing, and how many pixels a metre has there."""
    t = rng.beta(1, 2.5)
    deep = max(canvas.size - setting.horizon, 0.05 * canvas.size)
    return setting.horizon + t * deep, canvas.size * (0.012 + 0.11 * t) * rng.uniform(0.7, 1.3)


def _pole(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    foot, metre = _foot(canvas, setting, rng)
    x, tall, wide = rng.uniform(0, canvas.size), metre * rng.uniform(3, 9), max(0.7, metre * rng.uniform(0.08, 0.3))
    stencil = Stencil(canvas.size)
    stencil.box(x, foot - tall, x + wide, foot)
    if chance(rng, 0.5):  # a lamp
        arm = metre * rng.uniform(-1.2, 1.2)
        stencil.line([(x + wide / 2, foot - tall), (x + arm, foot - tall)], max(0.6, wide * 0.7))
        stencil.oval(x + arm, foot - tall, metre * 0.35 + 0.5, metre * 0.2 + 0.5)
    elif chance(rng, 0.3):
        stencil.box(x - metre, foot - tall * 0.95, x + metre, foot - tall * 0.92)
    _lay(canvas, stencil, GREYS, setting, rng)


def _wires(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    size = canvas.size
    stencil = Stencil(size)
    y, slope = rng.uniform(0, setting.horizon), rng.normal(0, 0.2) * size
    for k in range(int(rng.integers(1, 5))):
        t = np.linspace(0, 1, 9)
        sag = 4 * t * (1 - t) * size * 0.03
        stencil.line(
            [(float(u * size), float(y + k * size * 0.02 + slope * u + s)) for u, s in zip(t, sag, strict=True)], 0.5
        )
    _lay(canvas, stencil, ((0.15, 0.15, 0.16),), setting, rng)


def _fence(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    foot, metre = _foot(canvas, setting, rng)
    size, high = canvas.size, metre * rng.uniform(0.8, 1.8)
    gap, slope = metre * rng.uniform(0.12, 1.5), rng.normal(0, 0.05)
    stencil = Stencil(size)
    left, right = (-5.0, size + 5.0) if chance(rng, 0.6) else sorted(rng.uniform(-0.2, 1.2, 2) * size)
    for x in np.arange(left, right, max(gap, 2.0)):
        y = foot + slope * (x - size / 2)
        stencil.box(x, y - high, x + max(0.6, min(metre * 0.1, gap * 0.7)), y)
    for share in rng.uniform(0.2, 0.95, int(rng.integers(1, 4))):
        ends = [(x, foot + slope * (x - size / 2) - high * share) for x in (left, right)]
        stencil.line(ends, max(0.5, metre * 0.08))
    _lay(canvas, stencil, (*GREYS, (0.5, 0.38, 0.28), (0.9, 0.9, 0.88)), setting, rng)


def _rail(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """Thick brown rails, kerbs or logs near the tree, which are no trunk."""
    size = canvas.size
    y = setting.horizon + rng.uniform(0.1, 0.8) * (size - setting.horizon)
    x, long, slope = rng.uniform(-0.2, 0.8) * size, rng.uniform(0.15, 0.8) * size, rng.normal(0, 0.1)
    stencil = Stencil(size)
    stencil.line([(x, y), (x + long, y + long * slope)], size * rng.uniform(0.006, 0.03))
    _lay(canvas, stencil, ((0.42, 0.32, 0.24), (0.5, 0.45, 0.4), (0.3, 0.24, 0.2)), setting, rng)


def _car(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    foot, metre = _foot(canvas, setting, rng)
    x, long, high = rng.uniform(-0.1, 1.0) * canvas.size, metre * 4.4, metre * 1.5
    body, glass, wheels = (Stencil(canvas.size) for _ in range(3))
    body.polygon([
        (x + u * long, foot - v * high)
        for u, v in ((0, 0.2), (0, 0.55), (0.2, 0.62), (0.32, 1), (0.75, 1), (0.9, 0.62), (1, 0.55), (1, 0.2))
    ])  # fmt: skip
    glass.polygon(
        [(x + u * long, foot - v * high) for u, v in ((0.24, 0.62), (0.34, 0.93), (0.73, 0.93), (0.86, 0.62))]
    )
    for at in (0.2, 0.8):
        wheels.oval(x + at * long, foot - 0.2 * high, 0.22 * high, 0.22 * high)
    _lay(canvas, body, PAINTS, setting, rng)
    _lay(canvas, glass, ((0.12, 0.14, 0.16), (0.4, 0.46, 0.5)), setting, rng)
    _lay(canvas, wheels, ((0.1, 0.1, 0.1),), setting, rng)


def _bench(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    foot, metre = _foot(canvas, setting, rng)
    x = rng.uniform(0, canvas.size)
    stencil = Stencil(canvas.size)
    for share in (0.45, 0.65, 0.85):
        stencil.box(x, foot - metre * share, x + 1.8 * metre, foot - metre * (share - 0.1))
    for at in (0.1, 1.6):
        stencil.box(x + at * metre, foot - 0.85 * metre, x + (at + 0.1) * metre, foot)
    _lay(canvas, stencil, ((0.45, 0.33, 0.22), (0.3, 0.3, 0.3)), setting, rng)


def _sign(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    foot, metre = _foot(canvas, setting, rng)
    x, tall = rng.uniform(0, canvas.size), metre * rng.uniform(0.5, 2.6)
    post, board = Stencil(canvas.size), Stencil(canvas.size)
    post.box(x, foot - tall, x + max(0.6, 0.07 * metre), foot)
    board.box(x - 0.4 * metre, foot - tall, x + 0.5 * metre, foot - tall + metre * rng.uniform(0.25, 0.7))
    _lay(canvas, post, GREYS, setting, rng)
    _lay(canvas, board, (*PAINTS, (0.1, 0.1, 0.1), (0.2, 0.45, 0.3)), setting, rng)


def _stones(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    stencil = Stencil(canvas.size)
    for _ in range(int(rng.integers(1, 7))):
        foot, metre = _foot(canvas, setting, rng)
        x, wide, high = rng.uniform(0, canvas.size), metre * rng.uniform(0.3, 0.8), metre * rng.uniform(0.3, 1.2)
        stencil.box(x, foot - high * 0.8, x + wide, foot)
        stencil.oval(x + wide / 2, foot - high * 0.7, wide / 2, high * 0.3)
    _lay(canvas, stencil, ((0.6, 0.6, 0.58), (0.75, 0.74, 0.7), (0.45, 0.45, 0.46)), setting, rng)


def _person(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    foot, metre = _foot(canvas, setting, rng)
    x = rng.uniform(0, canvas.size)
    legs, coat, head = (Stencil(canvas.size) for _ in range(3))
    for step in (-0.14, 0.14):
        legs.line([(x, foot - 0.85 * metre), (x + step * metre, foot)], 0.18 * metre)
    coat.oval(x, foot - 1.1 * metre, 0.24 * metre, 0.4 * metre)
    head.oval(x, foot - 1.6 * metre, 0.12 * metre, 0.15 * metre)
    _lay(canvas, legs, ((0.15, 0.17, 0.25), (0.2, 0.2, 0.2), (0.5, 0.45, 0.35)), setting, rng)
    _lay(canvas, coat, PAINTS, setting, rng)
    _lay(canvas, head, ((0.8, 0.62, 0.5), (0.45, 0.3, 0.22)), setting, rng)
