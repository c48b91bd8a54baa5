"""Shapes: trees as people draw them with few lines: balls, clouds, tiers of triangles, drops, palms, discs on limbs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from scripts.mask_training.scenery.arrays import Rng, chance

Polygon = NDArray[np.float64]  # (n, 2), column and row


@dataclass(frozen=True, eq=False)
class Shape:
    """Parts of the crown from the farthest to the nearest, the trunk below them, limbs that are drawn over them."""

    crown: list[Polygon]
    trunk: list[Polygon]
    limbs: list[Polygon] = field(default_factory=list)


def drawn_shape(x: float, foot: float, height: float, rng: Rng) -> Shape:
    """A shape of chance that stands at column `x` and row `foot`, `height` pixels high."""
    kinds: tuple[tuple[Callable[[Rng], Shape], float], ...] = (
        (_ball, 0.27), (_cloud, 0.25), (_tiers, 0.2), (_drop, 0.1), (_palm, 0.06), (_discs, 0.12),
    )  # fmt: skip
    kind = kinds[int(rng.choice(len(kinds), p=[share for _, share in kinds]))][0]
    shape, wide = kind(rng), np.exp(rng.normal(0, 0.12))

    def placed(polygons: list[Polygon]) -> list[Polygon]:
        return [np.stack([x + p[:, 0] * height * wide, foot - p[:, 1] * height], axis=1) for p in polygons]

    return Shape(placed(shape.crown), placed(shape.trunk), placed(shape.limbs))


def ring(x: float, y: float, a: float, b: float, rng: Rng) -> Polygon:
    """An oval around (x, y) with half axes a and b whose edge is smooth, wavy, scalloped or jagged."""
    t = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    style, count = int(rng.integers(4)), int(rng.integers(5, 22))
    depth = rng.uniform(0.03, 0.14)
    if style == 0:
        radius = np.ones_like(t)
    elif style == 1:
        waves = np.array([2.0, 3.0, 5.0, 7.0])[:, None]
        radius = 1 + (np.sin(waves * t + rng.uniform(0, 7, (4, 1))) * depth / waves).sum(axis=0)
    elif style == 2:
        radius = 1 - depth + depth * np.abs(np.sin(count * t / 2)) * 1.6
    else:
        radius = 1 + depth * (np.arange(120) * count / 60 % 2 - 1 + rng.normal(0, 0.3, 120))
    return np.stack([x + a * radius * np.cos(t), y + b * radius * np.sin(t)], axis=1)


def _stem(top: float, rng: Rng, wide: float | None = None) -> Polygon:
    """A trunk from the ground to height `top`."""
    half = wide or rng.uniform(0.018, 0.07)
    narrow, flare = half * rng.uniform(0.5, 1.0), half * rng.uniform(1.0, 1.8)
    lean = rng.normal(0, 0.02)
    right = [(flare, 0), (half, 0.06), (narrow + lean, top)]
    left = [(-narrow + lean, top), (-half, 0.06), (-flare, 0)]
    return np.array(right + left)


def _ball(rng: Rng) -> Shape:
    bare, half = rng.uniform(0.12, 0.5), rng.uniform(0.2, 0.48)
    crown = ring(0, (1 + bare) / 2, half, (1 - bare) / 2, rng)
    return Shape([crown], [_stem(bare + 0.1, rng)], _limbs(bare, half, rng) if chance(rng, 0.4) else [])


def _limbs(bare: float, half: float, rng: Rng) -> list[Polygon]:
    """Tapered limbs that go up into the crown."""
    limbs = []
    for turn in rng.uniform(-0.7, 0.7, int(rng.integers(1, 4))):
        long, wide = (1 - bare) * rng.uniform(0.3, 0.7), rng.uniform(0.008, 0.022)
        x, y = np.sin(turn) * min(long, half), bare + long * np.cos(turn)
        limbs.append(np.array([[-wide, bare - 0.05], [wide, bare - 0.05], [x + 0.004, y], [x - 0.004, y]]))
    return limbs


def _cloud(rng: Rng) -> Shape:
    bare, half = rng.uniform(0.15, 0.5), rng.uniform(0.22, 0.45)
    parts = []
    for _ in range(int(rng.integers(3, 10))):
        turn, far = rng.uniform(0, 2 * np.pi), rng.uniform(0.2, 0.7)
        y = (1 + bare) / 2 + far * np.sin(turn) * (1 - bare) / 2
        size = rng.uniform(0.35, 0.6)
        b = min(size * (1 - bare) / 2, 1 - y) + 0.02
        parts.append(ring(far * np.cos(turn) * half, y, size * half, b, rng))
    return Shape(parts, [_stem(bare + 0.25, rng)], _limbs(bare, half, rng) if chance(rng, 0.3) else [])


def _tiers(rng: Rng) -> Shape:
    bare, half = rng.uniform(0.06, 0.25), rng.uniform(0.18, 0.4)
    count, parts = int(rng.integers(1, 6)), []
    teeth, curve = int(rng.integers(2, 12)), rng.uniform(-0.05, 0.08)
    for k in range(count):
        low = bare + (1 - bare) * k / count * 0.9
        top = min(1.0, low + (1 - bare) / count * rng.uniform(1.3, 1.8)) if k < count - 1 else 1.0
        wide = half * (1 - 0.75 * k / count) * rng.uniform(0.9, 1.1)
        t = np.linspace(-1, 1, 2 * teeth + 1)
        zigzag = np.where(np.arange(len(t)) % 2, 0.025, 0.0) if chance(rng, 0.5) else 0.0
        bottom = np.stack([t * wide, low - curve * (1 - t**2) + zigzag], axis=1)
        side = np.array([[wide * 0.4, low + (top - low) * rng.uniform(0.35, 0.55)], [0, top]])
        parts.append(np.concatenate([bottom, side, side[:1] * [-1, 1]]))
    return Shape(parts, [_stem(bare + 0.1, rng)])


def _drop(rng: Rng) -> Shape:
    bare, half = rng.uniform(0.05, 0.3), rng.uniform(0.1, 0.3)
    t = np.linspace(0, 1, 40)
    wide = half * np.sin(np.pi * t ** rng.uniform(0.45, 0.9)) ** rng.uniform(0.6, 1.0)
    y = bare + (1 - bare) * t
    return Shape([np.concatenate([np.stack([wide, y], 1), np.stack([-wide, y], 1)[::-1]])], [_stem(bare + 0.1, rng)])


def _palm(rng: Rng) -> Shape:
    top, bend = rng.uniform(0.65, 0.82), rng.normal(0, 0.15)
    t = np.linspace(0, 1, 12)
    x, wide = bend * t**2, rng.uniform(0.015, 0.04) * (1.3 - 0.6 * t)
    trunk = np.concatenate([np.stack([x + wide, t * top], 1), np.stack([x - wide, t * top], 1)[::-1]])
    fronds = []
    for turn in np.linspace(-0.4, np.pi + 0.4, int(rng.integers(5, 12))) + rng.normal(0, 0.12):
        long, thick, droop = rng.uniform(0.2, 0.36), rng.uniform(0.012, 0.05), rng.uniform(0.1, 0.5)
        along = np.stack(
            [bend + np.cos(turn) * long * t, top + np.sin(turn) * 0.75 * long * t - droop * long * t**2], 1
        )
        body = thick * np.sin(np.pi * t**0.7)[:, None] * np.array([0.4, 1.0])
        fronds.append(np.concatenate([along + body, (along - body)[::-1]]))
    return Shape(fronds, [trunk])


def _discs(rng: Rng) -> Shape:
    """Flat clouds of leaves at several heights of a visible trunk."""
    count, half, parts, limbs = int(rng.integers(2, 6)), rng.uniform(0.2, 0.4), [], []
    wide = rng.uniform(0.012, 0.035)
    for k in range(count):
        y = 0.32 + 0.58 * k / max(count - 1, 1)
        x = rng.normal(0, 0.06) if chance(rng, 0.5) else rng.choice([-1, 1]) * rng.uniform(0.08, 0.25)
        a = half * (1 - 0.5 * k / count) * rng.uniform(0.7, 1.1)
        parts.append(ring(x, y, a, min(rng.uniform(0.25, 0.6) * a, 1 - y), rng))
        limbs.append(np.array([[-wide * 0.5, y - 0.15], [wide * 0.5, y - 0.15], [x + 0.004, y], [x - 0.004, y]]))
    return Shape(parts, [_stem(0.85, rng, wide)], limbs)
