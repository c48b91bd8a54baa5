"""Ground: lawns, meadows, snow, roads, gravel, soil and water in perspective, with what lies on them."""

from __future__ import annotations

import numpy as np

from scripts.mask_training.scenery.arrays import Colour, Field, Floats, Rng, chance, smoothstep, tinted
from scripts.mask_training.scenery.canvas import Canvas, Stencil
from scripts.mask_training.scenery.noise import fractal, line, on_ground
from scripts.mask_training.scenery.setting import Setting

COLOURS: dict[str, tuple[Colour, ...]] = {
    "lawn": ((0.44, 0.58, 0.24), (0.38, 0.52, 0.20), (0.52, 0.64, 0.32), (0.50, 0.55, 0.28), (0.32, 0.46, 0.18)),
    "meadow": ((0.48, 0.56, 0.27), (0.58, 0.58, 0.32), (0.42, 0.50, 0.22), (0.66, 0.60, 0.36)),
    "snow": ((0.90, 0.92, 0.95), (0.84, 0.88, 0.94), (0.96, 0.96, 0.96)),
    "road": ((0.46, 0.46, 0.46), (0.36, 0.36, 0.38), (0.60, 0.58, 0.55), (0.55, 0.50, 0.46)),
    "gravel": ((0.64, 0.60, 0.53), (0.54, 0.50, 0.45), (0.70, 0.62, 0.50)),
    "soil": ((0.40, 0.30, 0.22), (0.50, 0.38, 0.27), (0.34, 0.27, 0.21), (0.58, 0.38, 0.26)),
    "water": ((0.36, 0.44, 0.48), (0.28, 0.34, 0.34), (0.50, 0.58, 0.64)),
    "dry": ((0.66, 0.58, 0.38), (0.56, 0.50, 0.32), (0.72, 0.66, 0.46)),
}
FAIRLY_EVEN = {
    "lawn": 0.10,
    "meadow": 0.20,
    "snow": 0.05,
    "road": 0.06,
    "gravel": 0.10,
    "soil": 0.16,
    "water": 0.08,
    "dry": 0.16,
}
GREEN = ("lawn", "meadow", "dry")


def paint_ground(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """Paint the land from the horizon down."""
    size, horizon = canvas.size, setting.horizon
    edge = horizon + line(size, size * rng.uniform(0.3, 1.5), rng, 3) * size * rng.choice([0.0, 0.004, 0.015])
    rows = np.arange(size, dtype=np.float32)[:, None]
    field = np.clip(rows - edge[None] + 0.5, 0, 1)
    picture = _surface(canvas, setting, setting.ground, rng)
    canvas.lay(picture, field)
    if chance(rng, 0.35) and setting.ground != "road":
        _path(canvas, setting, rng)
    if setting.ground == "lawn" and chance(rng, 0.2):
        _stripes(canvas, setting, field, rng)
    _litter(canvas, setting, rng)


def _surface(canvas: Canvas, setting: Setting, kind: str, rng: Rng) -> Floats:
    """Colours (h, w, 3) of ground of a kind; black well above the horizon."""
    size, horizon = canvas.size, setting.horizon
    above = int(np.clip(horizon - 0.06 * size, 0, 0.94 * size))
    rows = size - above
    choices = COLOURS[kind]
    first, second = (np.array(tinted(choices[int(rng.integers(len(choices)))], rng, 0.10)) for _ in range(2))
    air = np.array(setting.air)
    if setting.season == "autumn" and kind in GREEN:
        first = first * np.array([1.08, 0.97, 0.9])
    if kind == "water":
        first = 0.5 * first + 0.5 * air
    seed = int(rng.integers(2**20))
    patches = on_ground(rows, size, horizon - above, rng.uniform(1.0, 4.0), 3, seed)
    mix = smoothstep(patches, -0.8, 0.8) * np.float32(rng.uniform(0.3, 1.0))
    near = np.clip((np.arange(above, size) - horizon) / max(size - horizon, 1), 0, 1)
    tone = _texture(setting, kind, rows, size, horizon - above, rng)
    tone *= (1 + (near[:, None] - 0.6) * rng.uniform(-0.3, 0.1)).astype(np.float32)
    far = ((1 - near[:, None]) ** 3 * setting.haze * 0.7).astype(np.float32)
    painted = np.zeros((size, size, 3), np.float32)
    for k in range(3):
        colour = (np.float32(first[k]) + np.float32(second[k] - first[k]) * mix) * tone
        painted[above:, :, k] = colour + (np.float32(air[k]) - colour) * far
    return np.clip(painted, 0, 1)


def _texture(setting: Setting, kind: str, rows: int, size: int, horizon: float, rng: Rng) -> Field:
    """Light and dark (rows, size) of the ground, about 1 in an even light."""
    even = FAIRLY_EVEN[kind]
    if kind == "water":
        return np.float32(setting.shade) * (1 + np.float32(0.12) * fractal(rows, size, size * 0.02, rng, 3, 0.6, 8.0))
    fine = on_ground(rows, size, horizon, rng.uniform(12, 40), 3, int(rng.integers(2**20)))
    grain = rng.standard_normal((rows, size), dtype=np.float32)
    strength, grains = np.float32(even * rng.uniform(0.6, 1.8)), np.float32(even * rng.uniform(0.2, 1.0))
    tone: Field = (1 + fine * strength + grain * grains) * np.float32(setting.shade)
    return tone


def _path(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """A way, road or bed across the ground or towards the viewer."""
    size, horizon = canvas.size, setting.horizon
    deep = max(size - horizon, 2.0)
    kind = str(rng.choice(["road", "gravel", "soil", "dry", "lawn", "water"], p=(0.45, 0.25, 0.12, 0.08, 0.05, 0.05)))
    stencil = Stencil(size)
    if chance(rng, 0.65):  # across
        at = rng.uniform(0.02, 0.7)
        wide = deep * rng.uniform(0.03, 0.3) * (at + 0.15)
        x = np.linspace(-0.1 * size, 1.1 * size, 12)
        slope, bends = rng.normal(0, 0.12) * at, line(12, 6, rng, 2) * deep * 0.03 * at
        middle = horizon + deep * at + slope * (x - size / 2) + bends
        edge = np.concatenate([np.stack([x, middle - wide / 2], 1), np.stack([x, middle + wide / 2], 1)[::-1]])
        stencil.polygon(edge)
    else:  # towards the viewer
        far, foot = rng.uniform(0, size), rng.uniform(-0.5, 1.5) * size
        wide = rng.uniform(0.1, 0.6) * size
        t = np.linspace(0, 1, 8)
        x = far + (foot - far) * t + np.sin(t * 4) * rng.normal(0, 0.06) * size
        y = horizon + deep * t * 1.05
        stencil.polygon(np.concatenate([np.stack([x - wide * t / 2, y], 1), np.stack([x + wide * t / 2, y], 1)[::-1]]))
    canvas.lay(_surface(canvas, setting, kind, rng), stencil.opacity())


def _stripes(canvas: Canvas, setting: Setting, field: Field, rng: Rng) -> None:
    """Stripes that a mower leaves."""
    size = canvas.size
    y, x = np.mgrid[:size, :size].astype(np.float32)
    away = (size - setting.horizon) / np.maximum(y + 0.5 - setting.horizon, 0.5)
    turn = rng.uniform(-1.2, 1.2)
    along = ((x - size / 2) / size * np.cos(turn) + 0.6 * np.sin(turn)) * away * rng.uniform(3, 9)
    soft = np.clip(2.5 - away / 4, 0, 1)
    canvas.tone(1 + np.sign(np.sin(along * np.pi)) * field * soft * rng.uniform(0.02, 0.09))


def _litter(canvas: Canvas, setting: Setting, rng: Rng) -> None:
    """Fallen leaves, dandelions, stones and tufts of grass."""
    if setting.ground in GREEN:
        count = int(rng.integers(0, 450))
        t = rng.random(count) ** 0.7
        colour = np.array(COLOURS["meadow"])[rng.integers(4, size=count)] * (0.9 * setting.shade)
        colour = colour * np.exp(rng.normal(0, 0.25, (count, 1))) * np.array([0.85, 1.0, 0.75])
        _scatter(canvas, setting, t, colour, (0.9, 0.25), rng, opacity=0.35)
    kinds: list[tuple[Colour, float, float]] = []
    if setting.season == "autumn" and chance(rng, 0.7):
        kinds.append(((0.80, 0.55, 0.18), 0.35, rng.uniform(100, 1200)))
    if setting.ground in GREEN and setting.season != "autumn" and chance(rng, 0.25):
        kinds.append(
            (((0.95, 0.85, 0.2), (0.95, 0.95, 0.92), (0.8, 0.5, 0.7))[int(rng.integers(3))], 0.08, rng.uniform(30, 400))
        )
    if setting.ground in ("snow", "gravel", "soil", "road") and chance(rng, 0.4):
        kinds.append(((0.35, 0.30, 0.24), 0.3, rng.uniform(20, 300)))
    for base, spread, wanted in kinds:
        count = int(wanted)
        t = rng.random(count) ** rng.uniform(0.4, 1.0)
        colours = np.array(base) * np.exp(rng.normal(0, spread, (count, 1)) + rng.normal(0, 0.1, (count, 3)))
        _scatter(canvas, setting, t, colours * setting.shade, (0.45, 0.3), rng, opacity=0.9)


def _scatter(
    canvas: Canvas, setting: Setting, t: Floats, colour: Floats, shape: tuple[float, float], rng: Rng, opacity: float
) -> None:
    """Dabs on the ground at depths `t` (n,), 0 at the horizon and 1 at the lower edge; `shape` in hundredths."""
    size = canvas.size
    place = np.stack([rng.uniform(0, size, len(t)), setting.horizon + t * (size - setting.horizon)], axis=1)
    scale = (0.1 + t)[:, None] * size * 0.01 * np.exp(rng.normal(0, 0.25, (len(t), 1)))
    order = np.argsort(t)
    half = scale * np.array(shape)
    turn = rng.normal(np.pi / 2 if shape[0] > 0.6 else 0, 0.35, len(t))
    canvas.dabs(place[order], half[order], turn[order], np.clip(colour, 0, 1)[order], opacity)
