"""Blades: textures of leaves of one piece, with a midrib, veins and a stalk."""

from __future__ import annotations

import numpy as np

from treefit.asset.material.leaf_form import BASE, blade_form, coverage
from treefit.asset.material.noise import Field, fractal, ramp
from treefit.asset.material.texture import Drawing
from treefit.asset.mesh.leaf_frame import LeafFrame
from treefit.asset.mesh.leaf_outline import leaf_frame
from treefit.plant import LeafShape

# veins on either side, their slope to the tip at the midrib, and how much they bend on
_VEINS = {
    "broad": (8, 0.75, 0.25), "round": (6, 0.9, 0.3), "narrow": (16, 0.5, 0.5), "oak": (5, 0.75, 0.1),
    "lobed": (7, 0.8, 0.2), "needle": (1, 0.0, 0.0),
}  # fmt: skip


def blade_drawing(shape: LeafShape, n: int) -> Drawing:
    """Leaf of `shape` in the square of its frame, n by n texels."""
    frame = leaf_frame(shape)
    x, y = places(frame, n)
    stalk = np.array([[-0.013, 0.0], [0.013, 0.0], [0.009, 0.2], [-0.009, 0.2]]) * [frame.half_width / 0.6, 1]
    alpha = coverage([blade_form(shape), stalk], frame, n)
    main, lateral, quilt = _palmate(x, y, frame) if shape == "lobed" else _pinnate(shape, x, y, frame)
    net = 1 - ramp(0.0, 0.35, np.abs(fractal(n, 61, n / 6, 24, 0.3)))
    cloud, grain = fractal(n, 62, 12, 2), fractal(n, 63, n / 3, 40, 0.5)
    rim = ramp(0.0, 0.12, 1 - np.abs(x) / np.float32(frame.half_width))
    veins = np.maximum(main, 0.6 * lateral)
    light = 0.93 + 0.07 * quilt + 0.06 * cloud + 0.03 * grain - 0.05 * rim + 0.04 * net + 0.55 * veins
    light *= 0.94 + 0.1 * y
    yellow = np.clip(0.85 * veins + 0.12 * cloud + 0.08 * net + 0.6 * (1 - ramp(BASE, BASE + 0.05, y)), 0, 1)
    hue = 1 + yellow[..., None] * np.array([0.32, 0.06, -0.1], np.float32)
    height = 0.02 / _VEINS[shape][0] * quilt - 0.006 * main - 0.003 * lateral - 0.0006 * net + 0.0004 * grain
    return Drawing(light[..., None] * hue, height, 0.62 + 0.2 * veins + 0.05 * grain, alpha)


def places(frame: LeafFrame, n: int) -> tuple[Field, Field]:
    """Places across and along the leaf (n, n) of the texels of its square."""
    at = (np.arange(n) + 0.5) / n
    across, along = frame.xy(np.column_stack([at, 1 - at])).astype(np.float32).T
    return np.broadcast_to(across[None], (n, n)), np.broadcast_to(along[:, None], (n, n))


def _pinnate(shape: str, x: Field, y: Field, frame: LeafFrame) -> tuple[Field, Field, Field]:
    """Midrib, side veins and how the blade bulges between them."""
    count, slope, bend = _VEINS[shape]
    side, wide = np.abs(x) / np.float32(frame.half_width), frame.half_width
    main = np.exp(-((x / (wide * (0.030 - 0.02 * y))) ** 2))
    if count == 1:
        return main, 0 * main, np.cos(side * np.float32(2 * np.pi))
    start = (y - slope * side * wide * 0.6 - bend * wide * 0.6 * side**2 - BASE) * count / (1 - BASE)
    phase = start + np.where(x < 0, np.float32(0.35), np.float32(0))
    off = np.abs(phase - np.round(phase)) * (1 - BASE) / count
    inner = ramp(0.0, 1.0, start + 0.6)
    lateral = np.exp(-((off / (0.012 - 0.008 * side)) ** 2)) * inner * (1 - 0.6 * side)
    return main, lateral, 1 - 2 * np.exp(-((off * count / 0.25) ** 2)) * inner


def _palmate(x: Field, y: Field, frame: LeafFrame) -> tuple[Field, Field, Field]:
    """Veins from the foot of the blade to its five lobes, and veins from these."""
    tips = np.array([[0, 1], [0.52, 0.56], [-0.52, 0.56], [0.37, 0.03], [-0.37, 0.03]])
    ways = (tips * [frame.half_width / 0.52, 1]) - [0, BASE]
    length = np.linalg.norm(ways, axis=1)
    main, nearest = np.zeros_like(x), np.full_like(x, 9)
    lateral, quilt = np.zeros_like(x), np.zeros_like(x)
    for (dx, dy), long in zip(ways / length[:, None], length, strict=True):
        along, off = (x * dx + (y - BASE) * dy) / long, np.abs(x * dy - (y - BASE) * dx)
        angle = off / np.maximum(along * long, 1e-4)
        mine = (angle < nearest) & (along > 0)
        nearest = np.where(mine, angle, nearest)
        main = np.maximum(main, np.exp(-((off / (0.018 - 0.012 * np.clip(along, 0, 1))) ** 2)) * (along > 0))
        phase = (along * long - 0.9 * off) * 9
        near = np.abs(phase - np.round(phase)) / 9
        lateral = np.where(mine, np.exp(-((near / 0.008) ** 2)), lateral)
        quilt = np.where(mine, 1 - 2 * np.exp(-((near * 9 / 0.25) ** 2)), quilt)
    return main, lateral * 0.8, quilt
