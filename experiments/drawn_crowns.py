"""Drawn crowns: masks of trees that no generator has grown, by outline, bare trunk, gaps and fans of branches."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from treefit.mask import BRANCH, FOLIAGE, Mask

ROWS, COLUMNS = 256, 512

Heights = NDArray[np.float64]
Outline = Callable[[Heights], Heights]


@dataclass(frozen=True)
class Habit:
    """Outline of a crown, half width at heights 0 to 1 of it, and ranges of its proportions in heights of the tree."""

    outline: Outline
    bare: tuple[float, float]
    half_width: tuple[float, float]


HABITS = {
    "ellipse": Habit(lambda t: np.sqrt(1 - (2 * t - 1) ** 2), (0.1, 0.4), (0.25, 0.5)),
    "cone": Habit(lambda t: (1 - t) * np.minimum(1, 12 * t), (0.03, 0.25), (0.18, 0.4)),
    "column": Habit(lambda t: (1 - np.abs(2 * t - 1) ** 5) ** 0.2, (0.03, 0.15), (0.1, 0.2)),
    "umbrella": Habit(lambda t: np.sqrt(1 - t**2) * np.minimum(1, 6 * t + 0.3), (0.5, 0.7), (0.4, 0.7)),
    "irregular": Habit(lambda t: np.sqrt(1 - (2 * t - 1) ** 2), (0.1, 0.45), (0.25, 0.55)),
    "vase": Habit(lambda t: (0.2 + 0.8 * t) * np.sqrt(1 - t**6), (0.15, 0.35), (0.3, 0.55)),
    "bare": Habit(lambda t: np.sqrt(1 - (2 * t - 1) ** 2), (0.12, 0.35), (0.25, 0.5)),
}
"""Kinds of crowns by name; "bare" has branches alone."""


def drawn_crown(name: str, seed: int) -> Mask:
    """Mask (256, 512) of a tree of a kind by `name`; the same for the same `seed`."""
    rng, habit = np.random.default_rng([seed, *name.encode()]), HABITS[name]
    bare, half = rng.uniform(*habit.bare), rng.uniform(*habit.half_width)
    height, across = _axes()
    t = np.clip((height - bare) / (1 - bare), 0, 1)
    width = half * np.nan_to_num(habit.outline(t)) * (height >= bare)
    rough = rng.uniform(0.05, 0.15) if name != "irregular" else rng.uniform(0.35, 0.6)
    within = [(side * across >= 0) & (side * across < width * (1 + rough * _wave(rng, t))) for side in (-1, 1)]
    crown = within[0] | within[1]
    branches = _fan(rng, bare, half) & (crown | (height < bare))
    gaps = _noise(rng, 4.0) > np.quantile(_noise(rng, 4.0), 1 - rng.uniform(0.0, 0.3))
    mask = np.zeros((ROWS, COLUMNS), np.uint8)
    if name != "bare":
        mask[crown & ~gaps] = FOLIAGE
        branches &= (mask == 0) | (_noise(rng, 6.0) > 0.5)
    mask[branches | _trunk(rng, bare, half)] = BRANCH
    return mask


def _axes() -> tuple[Heights, Heights]:
    """Heights (ROWS, 1) from the ground and distances (1, COLUMNS) from the trunk, in heights of the tree."""
    return 1 - (np.arange(ROWS)[:, None] + 0.5) / ROWS, (np.arange(COLUMNS)[None] + 0.5 - COLUMNS / 2) / ROWS


def _wave(rng: np.random.Generator, t: Heights) -> Heights:
    """Sum of a few waves along `t`, in [-1, 1]."""
    waves = [np.sin(2 * np.pi * (k * t + rng.random())) * rng.uniform(0.3, 1) / k**0.5 for k in (1, 2, 3, 5, 8)]
    total: Heights = np.sum(waves, axis=0) / 2.9
    return total


def _noise(rng: np.random.Generator, size: float) -> Heights:
    """Smooth noise (ROWS, COLUMNS) with blobs of `size` pixels, of deviation 1."""
    noise: Heights = gaussian_filter(rng.standard_normal((ROWS, COLUMNS)), size)
    return np.asarray(noise / noise.std())


def _trunk(rng: np.random.Generator, bare: float, half: float) -> NDArray[np.bool_]:
    """Pixels of a trunk that ends a little above the bare part."""
    height, across = _axes()
    radius = rng.uniform(0.02, 0.05) * (0.4 + half) * np.clip(1.1 - height, 0.2, 1)
    lean = rng.uniform(-0.05, 0.05) * height
    pixels: NDArray[np.bool_] = (np.abs(across - lean) < radius) & (height < bare + 0.12)
    return pixels


def _fan(rng: np.random.Generator, bare: float, half: float) -> NDArray[np.bool_]:
    """Pixels of branches that fan out from the trunk, each with twigs."""
    pixels = np.zeros((ROWS, COLUMNS), bool)
    for _ in range(rng.integers(8, 20)):
        foot = bare + (1 - bare) * rng.uniform(-0.05, 0.6)
        angle, length = rng.uniform(-1.2, 1.2), rng.uniform(0.5, 1.2) * max(half, 0.3)
        _stroke(pixels, (0.0, foot), angle, length, 0.008)
        for along in rng.uniform(0.3, 1.0, rng.integers(3, 9)):
            start = (along * length * np.sin(angle), foot + along * length * np.cos(angle))
            _stroke(pixels, start, angle + rng.uniform(-0.9, 0.9), length * rng.uniform(0.2, 0.5), 0.004)
    return pixels


def _stroke(pixels: NDArray[np.bool_], start: tuple[float, float], angle: float, length: float, radius: float) -> None:
    """Draw a line from `start` (across, height), `angle` from upwards, in heights of the tree."""
    height, across = _axes()
    part = _around(height[:, 0], start[1], length + 2 * radius), _around(across[0], start[0], length + 2 * radius)
    x, y = across[:, part[1]] - start[0], height[part[0]] - start[1]
    along = np.clip(x * np.sin(angle) + y * np.cos(angle), 0, length)
    pixels[part] |= np.hypot(x - along * np.sin(angle), y - along * np.cos(angle)) < radius * (1.3 - along / length)


def _around(places: Heights, middle: float, reach: float) -> slice:
    """Part of ordered `places` that is within `reach` of `middle`."""
    found = np.flatnonzero(np.abs(places - middle) <= reach)
    return slice(int(found[0]), int(found[-1]) + 1) if len(found) else slice(0)
