"""Conifers: whorls of branches with sprays of needles, from the ground or from high up a bare trunk."""

from __future__ import annotations

import numpy as np

from scripts.mask_training.scenery.arrays import Rng, chance
from scripts.mask_training.scenery.model import Model, unit


def whorled(rng: Rng, leaves: int) -> Model:
    """A conifer with about `leaves` sprays: spruce, fir, larch, cedar or thuja by its proportions."""
    bare = rng.uniform(0.0, 0.1) if chance(rng, 0.75) else rng.uniform(0.1, 0.4)
    half, power = rng.uniform(0.13, 0.34), rng.uniform(0.55, 1.3)
    whorls, arms = int(rng.integers(14, 40)), int(rng.integers(5, 11))
    t = np.repeat(np.linspace(0, 0.99, whorls), arms) + rng.normal(0, rng.uniform(0.1, 0.6) / whorls, whorls * arms)
    t = np.clip(t, 0, 0.995)
    turn = rng.uniform(0, 2 * np.pi, len(t))
    long = half * (1 - t) ** power * np.exp(rng.normal(0, rng.uniform(0.08, 0.3), len(t))) + 0.012
    long *= 1 + 0.2 * np.sin(turn + rng.uniform(0, 7)) * rng.random()
    # young branches rise, old ones hang
    rise = rng.uniform(-0.7, 0.35) * (1 - t) + rng.uniform(0.2, 0.9) * t
    foot = np.stack([np.zeros_like(t), np.zeros_like(t), bare + (1 - bare) * t * 0.97], axis=1)
    arm = np.stack([np.cos(turn), np.sin(turn), rise], axis=1) * long[:, None]
    tip = foot + arm
    tip[:, 2] = np.maximum(tip[:, 2], 0.01)
    share = long / long.sum()
    rows = np.repeat(np.arange(len(t)), np.maximum(2, np.round(share * leaves).astype(int)))
    place, axis, normal = _sprays(foot, tip, long, rows, rng)
    size = rng.uniform(0.008, 0.02) * np.exp(rng.normal(0, 0.3, len(rows)))
    girth = rng.uniform(0.008, 0.02)
    up = np.linspace(-0.004, 0.97, 9)
    trunk = np.stack([rng.normal(0, 0.003, 9), rng.normal(0, 0.003, 9), up], axis=1)
    width = girth * np.linspace(1.15, 0.05, 9)
    half_arm = foot + (tip - foot) * 0.8
    return Model(
        np.concatenate([trunk[:-1], foot]).astype(np.float32), np.concatenate([trunk[1:], half_arm]).astype(np.float32),
        np.concatenate([width[:-1], girth * (0.1 + 0.15 * (1 - t))]).astype(np.float32),
        np.concatenate([width[1:], np.full(len(t), girth * 0.06)]).astype(np.float32),
        place, axis, normal, np.stack([size, size * rng.uniform(0.25, 0.55)], axis=1).astype(np.float32), conifer=True,
    )  # fmt: skip


def _sprays(
    foot: np.ndarray, tip: np.ndarray, long: np.ndarray, rows: np.ndarray, rng: Rng
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places, axes, normals (k, 3) along the branches `rows`, widest at their middle, hanging a little."""
    s = rng.beta(2.0, 1.3, len(rows))[:, None]
    arm = (tip - foot)[rows]
    side = unit(np.cross(arm, [0.0, 0.0, 1.0]).astype(np.float32))
    spread = (long[rows] * rng.uniform(0.12, 0.3))[:, None] * np.sqrt(s) * (1.15 - s)
    across = rng.standard_normal((len(rows), 1)) * spread
    hang = -np.abs(rng.standard_normal((len(rows), 1))) * rng.uniform(0.1, 0.6) * spread
    bow = 4 * s * (1 - s) * rng.uniform(-0.12, 0.12) * long[rows, None]
    place = foot[rows] + arm * s + side * across
    place[:, 2:] += hang + bow + rng.standard_normal((len(rows), 1)) * 0.006
    place[:, 2] = np.maximum(place[:, 2], 0.0)
    axis = unit(
        (arm / long[rows, None] + side * np.sign(across) * 0.8 + rng.normal(0, 0.4, arm.shape)).astype(np.float32)
    )
    normal = unit((np.array([0, 0, 1.0]) + rng.normal(0, 0.45, arm.shape)).astype(np.float32))
    return place.astype(np.float32), axis, unit(normal - axis * (normal * axis).sum(axis=1, keepdims=True))
