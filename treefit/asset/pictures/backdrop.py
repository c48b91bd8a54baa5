"""Backdrop: a pale sky and a pale ground with the plant's shadow, behind its picture."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageFilter

from treefit.asset.material.colour import Colour, to_linear, to_srgb
from treefit.asset.pictures.frame import Frame
from treefit.asset.pictures.light import SunMap
from treefit.asset.pictures.scene import Scene

Floats = NDArray[np.float32]

_TILT = 0.15  # the ground is drawn as seen from a little above, or it would be a line
_ZENITH: Colour = (176, 201, 224)
_HORIZON: Colour = (243, 242, 236)
_FAR: Colour = (225, 224, 210)
_NEAR: Colour = (196, 196, 174)
_TAKEN = np.array([0.60, 0.56, 0.47], dtype=np.float32)  # what deep shadow takes from each channel: the sky stays


def backdrop(frame: Frame, sun: SunMap, scene: Scene) -> Floats:
    """Picture (h, w, 3) sRGB in [0, 1] of sky and ground, with the shadow of the plant in `scene`."""
    h = frame.height
    rows = (np.arange(h, dtype=np.float32) + 0.5)[:, None, None]
    down = np.clip(rows / frame.base, 0, 1) ** 1.15
    sky = to_linear(_ZENITH) * (1 - down) + to_linear(_HORIZON) * down
    near = np.clip((rows - 0.86 * frame.base) / (h - 0.86 * frame.base), 0, 1)
    ground = to_linear(_FAR) * (1 - near) + to_linear(_NEAR) * near
    haze = np.clip((rows - frame.base + 0.125 * h) / (0.11 * h), 0, 1)
    haze = haze * haze * (3 - 2 * haze)
    shadow = _ground_shadow(frame, sun, scene)[..., None]
    image = (sky * (1 - haze)).astype(np.float32) + (ground * haze).astype(np.float32) * (1 - shadow * _TAKEN)
    return to_srgb(image)


def ground_rise(scene: Scene) -> Floats:
    """Metres (n,) by which corners are drawn higher: those at the ground stand on it as it is drawn."""
    height = np.maximum(scene.place[:, 2], 0) / (0.03 * scene.tall)
    return np.asarray(_TILT * scene.place[:, 1] * np.exp(-height * height), dtype=np.float32)


def _ground_shadow(frame: Frame, sun: SunMap, scene: Scene) -> Floats:
    """Darkness (h, w) in [0, 1] of the ground: sharp at the foot, softer away from it, and less sky under the crown."""
    h, w = frame.height, frame.width
    tall, reach = scene.tall, float(np.abs(scene.place[:, :2]).max())
    first = int(0.74 * h)
    y = ((frame.base - np.arange(first, h) - 0.5) / (frame.scale * _TILT)).astype(np.float32)[:, None]
    x = ((np.arange(w) + 0.5 - w / 2) / frame.scale).astype(np.float32)[None]
    axes = sun.turn[:2, :2] @ np.stack(np.broadcast_arrays(x, y)).reshape(2, -1)
    at = (axes + sun.shift[:2, None]).astype(np.int32)
    size = sun.depth.shape[0]
    inside = ((at >= 0) & (at < size)).all(axis=0)
    at = np.clip(at, 0, size - 1)
    dark = (inside & np.isfinite(sun.depth[at[1], at[0]])).reshape(h - first, w)
    blocked = Image.fromarray((dark * 255).astype(np.uint8))
    sharp, soft = (
        np.asarray(blocked.filter(ImageFilter.GaussianBlur((share * h, 0.45 * share * h))), dtype=np.float32) / 255
        for share in (0.003, 0.014)
    )
    distance = np.hypot(x, y) / tall
    away = np.clip(distance / 0.9, 0, 1)
    contact = np.exp(-((distance / 0.045) ** 2)) * 0.6
    under = np.exp(-((np.hypot(x, y) / (0.8 * reach + 0.1 * tall)) ** 2)) * 0.22
    cast = sharp * (1 - away) + soft * away
    shadow = np.zeros((h, w), dtype=np.float32)
    shadow[first:] = 1 - (1 - 0.8 * cast) * (1 - contact) * (1 - under)
    return shadow
