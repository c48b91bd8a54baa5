"""Feathers: textures of leaves of many slips: fronds, twigs of needles, sprays of scales and compound leaves."""

from __future__ import annotations

import numpy as np

from treefit.asset.material.leaf_slips import SLIPS
from treefit.asset.material.noise import ramp
from treefit.asset.material.strokes import Samples, Values, draw
from treefit.asset.material.texture import Drawing
from treefit.asset.mesh.leaf_outline import leaf_frame
from treefit.plant import LeafShape

_WOOD = (1.5, 0.75, 0.6)  # hue of twigs over that of leaves
_YELLOW = (0.3, 0.08, -0.05)  # more of each channel in veins and tips


def feather_drawing(shape: LeafShape, n: int) -> Drawing:
    """Leaf of `shape` in the square of its frame, n by n texels."""
    slips = SLIPS[shape]()
    seen = draw(slips.strokes, slips.profile, leaf_frame(shape), n)
    vein = np.maximum(_midrib(seen, slips.midrib), _side_veins(seen, slips.veins)) * (1 - seen.wood)
    bulge = 1 - np.minimum(seen.across * seen.across, 1)
    light = seen.shade * (0.72 + 0.28 * bulge) * (0.86 + 0.2 * ramp(0.0, 0.5, seen.along)) * (1 + 0.5 * vein)
    yellow = 0.25 * seen.along + 0.8 * vein
    tone = np.stack([seen.mean(_hue(light, yellow, seen.wood, channel)) for channel in range(3)], axis=-1)
    height = seen.mean(0.008 * np.sqrt(bulge) + 0.012 * seen.order - 0.004 * vein)
    return Drawing(tone, height, seen.mean(0.6 + 0.3 * seen.wood + 0.1 * vein), seen.share())


def _hue(light: Values, yellow: Values, wood: Values, channel: int) -> Values:
    green = 1 + yellow * np.float32(_YELLOW[channel])
    return light * (green + wood * (np.float32(_WOOD[channel]) - green))


def _midrib(seen: Samples, width: float) -> Values:
    return np.asarray(np.float32(0.6) * np.exp(-((seen.across / np.float32(width)) ** 2)))


def _side_veins(seen: Samples, count: int) -> Values:
    if count == 0:
        return np.zeros_like(seen.along)
    side = np.abs(seen.across)
    phase = (seen.along - np.float32(0.16) * side) * count
    ridge = np.exp(-(((phase - np.round(phase)) / np.float32(0.13)) ** 2))
    return np.asarray(np.float32(0.27) * ridge * (1 - np.float32(0.6) * side))
