"""Sky: gradients from the zenith to the horizon and clouds of several kinds."""

from __future__ import annotations

import numpy as np

from scripts.mask_training.scenery.arrays import Field, Floats, Rng, blend, chance, smoothstep
from scripts.mask_training.scenery.canvas import Canvas
from scripts.mask_training.scenery.noise import fractal
from scripts.mask_training.scenery.setting import Setting


def paint_sky(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """Fill the whole canvas with a sky."""
    top, low = _ends(setting, rng)
    size = canvas.size
    t = np.clip((np.arange(size, dtype=np.float32) + 0.5) / max(setting.horizon, 1), 0, 1) ** rng.uniform(0.6, 1.8)
    side = (np.arange(size, dtype=np.float32) / size - 0.5) * rng.normal(0, 0.06)
    canvas.rgb[...] = (top + (low - top) * t[:, None])[:, None] * (1 + side)[None, :, None]
    if setting.weather == "dusk" or chance(rng, 0.1):
        _glow(canvas, setting, rng)
    kinds = {
        "clear": (0.25, 0.3), "cloudy": (1.0, 0.3), "overcast": (0.6, 0.0), "haze": (0.2, 0.2), "dusk": (0.7, 0.5),
        "storm": (1.0, 0.0),
    }[setting.weather]  # fmt: skip
    if chance(rng, kinds[1]):
        _cirrus(canvas, setting, rng)
    if chance(rng, kinds[0]):
        _cumulus(canvas, setting, rng)


def _ends(setting: Setting, rng: Rng) -> tuple[Floats, Floats]:
    """Colours (3,) at the top of the picture and at the horizon."""
    weather = setting.weather
    if weather in ("clear", "cloudy"):
        deep = rng.uniform(0, 1)
        top = np.array([0.16, 0.36, 0.66]) * deep + np.array([0.52, 0.70, 0.90]) * (1 - deep)
        top *= rng.uniform(0.8, 1.12)
        if chance(rng, 0.06):
            top = top[[0, 2, 2]] * np.array([1.0, rng.uniform(0.8, 0.95), rng.uniform(0.85, 1.0)])  # old films: cyan
        low = top + (np.array([0.80, 0.87, 0.94]) - top) * rng.uniform(0.1, 1.0)
    elif weather in ("overcast", "haze"):
        grey = rng.uniform(0.72, 1.0) if chance(rng, 0.7) else 1.0
        top = grey * (1 + rng.normal(0, 0.025, 3))
        low = top * rng.uniform(0.9, 1.08)
    elif weather == "storm":
        top = rng.uniform(0.3, 0.55) * np.array([0.92, 0.98, 1.08])
        low = top * rng.uniform(1.0, 1.5)
    else:
        top = np.array([rng.uniform(0.1, 0.5), rng.uniform(0.15, 0.5), rng.uniform(0.3, 0.7)])
        low = np.array([rng.uniform(0.7, 1.0), rng.uniform(0.4, 0.75), rng.uniform(0.2, 0.6)])
    return np.clip(top, 0, 1).astype(np.float32), np.clip(low, 0, 1).astype(np.float32)


def _glow(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """Light around the sun, low over the horizon."""
    size = canvas.size
    y, x = np.mgrid[:size, :size].astype(np.float32)
    at = rng.uniform(0, size), setting.horizon - rng.uniform(-0.1, 0.5) * size
    far = np.hypot(x - at[0], (y - at[1]) * 1.3) / (size * rng.uniform(0.15, 0.6))
    blend(canvas.rgb, (1.0, rng.uniform(0.8, 0.97), rng.uniform(0.5, 0.9)), np.exp(-(far**1.2)) * rng.uniform(0.4, 1.0))


def _cumulus(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """Clouds with light tops and grey undersides."""
    size = canvas.size
    step = max(1, size // 24)
    noise = fractal(size + step, size, size * rng.uniform(0.15, 0.6), rng, 6, 0.58, rng.uniform(1.3, 3))
    body, above = _towards_horizon(noise[step:], setting), _towards_horizon(noise[:-step], setting)
    amount = rng.uniform(-0.8, 1.4) if setting.weather != "clear" else rng.uniform(0.6, 1.6)
    opacity = smoothstep(body, amount, amount + rng.uniform(0.3, 1.5)) * rng.uniform(0.5, 1.0)
    # thick above means dark below
    dark = rng.uniform(0.0, 0.35) if setting.weather != "storm" else rng.uniform(0.3, 0.6)
    light = np.clip(1 - dark * smoothstep(above, amount, amount + 2), 0, 1)
    white = np.array([0.98, 0.98, 0.99], np.float32) if setting.weather != "overcast" else canvas.rgb.mean(axis=(0, 1))
    if setting.weather == "dusk":
        white = np.array([rng.uniform(0.4, 1.0), rng.uniform(0.35, 0.7), rng.uniform(0.35, 0.65)], np.float32)
    blend(canvas.rgb, white * light[..., None], opacity)


def _cirrus(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """Thin streaks."""
    size = canvas.size
    streaks = _towards_horizon(fractal(size, size, size * 0.12, rng, 5, 0.7, rng.uniform(3, 8)), setting)
    blend(canvas.rgb, (0.97, 0.97, 0.99), smoothstep(streaks, 0.0, 2.5) * rng.uniform(0.2, 0.7))


def _towards_horizon(noise: Field, setting: Setting) -> Field:
    """`noise` with its rows pressed together towards the horizon, as clouds are far away there."""
    size = len(noise)
    t = np.clip((np.arange(size) + 0.5) / max(setting.horizon, 1), 0, 1)
    rows = ((0.55 * t + 0.45 * t**3) * (size - 1)).astype(int)
    pressed: Field = noise[rows]
    return pressed
