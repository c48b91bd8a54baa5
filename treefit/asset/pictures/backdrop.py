"""Backdrop: a pale sky and a pale ground with the plant's shadow, behind its picture."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageFilter

from treefit.asset.material.colour import to_linear
from treefit.asset.pictures.frame import Frame
from treefit.asset.pictures.light import SunMap

Floats = NDArray[np.float32]

_TILT = 0.15  # the ground is drawn as seen from a little above, or it would be a line


def backdrop(frame: Frame, sun: SunMap, tall: float) -> Floats:
    """Linear (h, w, 3): pale sky, pale ground and the plant's shadow on it."""
    h = frame.height
    rows = (np.arange(h) + 0.5)[:, None, None]
    sky_share = np.clip(rows / frame.base, 0, 1) ** 1.3
    sky = to_linear((203, 219, 233)) * (1 - sky_share) + to_linear((243, 243, 238)) * sky_share
    ground_share = np.clip((rows - frame.base) / (h - frame.base), 0, 1)
    ground = to_linear((216, 214, 198)) * (1 - ground_share) + to_linear((199, 197, 178)) * ground_share
    rise = np.clip((rows - frame.base + 0.115 * h) / (0.10 * h), 0, 1)
    rise = rise * rise * (3 - 2 * rise)
    shadow = _ground_shadow(frame, sun, tall)[..., None]
    ground = ground * (1 - shadow * np.array([0.48, 0.45, 0.39]))
    return np.ascontiguousarray(sky * (1 - rise) + ground * rise, dtype=np.float32)


def _ground_shadow(frame: Frame, sun: SunMap, tall: float) -> Floats:
    """Darkness (h, w) in [0, 1] of the ground: the plant's own shadow, softer than the sun would draw it."""
    h, w = frame.height, frame.width
    row, column = np.mgrid[0:h:2, 0:w:2] + 1.0
    x = (column - w / 2) / frame.scale
    y = (frame.base - row) / (frame.scale * _TILT)
    at = sun.project(np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3).astype(np.float32))
    size = sun.depth.shape[0]
    inside = (at[:, :2] >= 0).all(axis=1) & (at[:, :2] < size).all(axis=1)
    cell = np.clip(at[:, :2].astype(np.int64), 0, size - 1)
    dark = inside & np.isfinite(sun.depth[cell[:, 1], cell[:, 0]])
    blocked = Image.fromarray((dark.reshape(x.shape) * 255).astype(np.uint8))
    soft = blocked.filter(ImageFilter.GaussianBlur(0.0028 * h)).resize((w, h), Image.Resampling.BILINEAR)
    contact = np.exp(-((np.hypot(x, y) / (0.045 * tall)) ** 2))
    near = Image.fromarray((contact * 160).astype(np.uint8)).resize((w, h), Image.Resampling.BILINEAR)
    darkness = np.maximum(np.asarray(soft), np.asarray(near))
    return np.asarray(darkness / 255, dtype=np.float32)
