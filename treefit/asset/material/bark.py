"""Bark: a square metre of it, seamless in both directions; relief, shades and gloss of four kinds."""

from __future__ import annotations

from functools import cache

import numpy as np

from treefit.asset.material.cells import cells
from treefit.asset.material.noise import Field, fractal, ramp
from treefit.asset.material.texture import Colours, Drawing, Textures, textures_of


def furrowed(n: int) -> Drawing:
    """Oak, ash, poplar: ridges some 6 cm apart that part and meet, deep dark furrows between them."""
    sway, fibre = fractal(n, 11, 40, 3, 1.0, 2.5), fractal(n, 12, 200, 20, 0.6, 8.0)
    lift, rough = fractal(n, 13, 16, 2), fractal(n, 14, 220, 30, 0.7)
    warp = (0.009 * sway + 0.0012 * fibre, 0.02 * lift)
    ridges, scales = cells(n, 16, 3, 15, warp, 0.75), cells(n, 24, 10, 16, (warp[0] + 0.003 * rough, warp[1]), 0.9)
    top = ramp(0.015, 0.2, ridges.border + 0.015 * rough + 0.015 * fibre)
    crack = ramp(0.015, 0.1, scales.border + 0.015 * rough)
    height = top * (0.82 + 0.18 * crack) + 0.06 * top * fibre + 0.03 * rough + 0.12 * (ridges.draw - 0.5) * top
    light = 0.26 + 0.74 * top * (0.7 + 0.3 * crack)
    light *= 1 + 0.12 * fibre * top + 0.07 * rough + 0.2 * (scales.draw - 0.5) * top
    weathered = np.clip(top - 0.35 + 0.2 * rough, 0, 1)
    return Drawing(_tinted(light, weathered, (1.12, 1.0, 0.84), (0.98, 1.0, 1.01)), 0.02 * height, 0.95 - 0.1 * top)


def plated(n: int) -> Drawing:
    """Pine: flat plates of 8 by 16 cm in layers that flake off, dark cracks between them."""
    sway, lift = fractal(n, 21, 30, 3, 1.1), fractal(n, 22, 30, 3, 1.1)
    rough, flakes = fractal(n, 23, 220, 24, 0.7), fractal(n, 24, 70, 6, 1.0, 0.7)
    plates = cells(n, 12, 6, 25, (0.009 * sway, 0.016 * lift), 0.8)
    chips = cells(n, 28, 20, 26, (0.006 * sway + 0.004 * flakes, 0.010 * lift + 0.003 * flakes), 0.9)
    top = ramp(0.01, 0.12, plates.border + 0.012 * rough)
    layers = 0.5 * flakes + 1.6 * plates.draw + 1.3 * chips.draw + 2.4 * plates.border
    steps = np.floor(layers * 1.4)
    edge = ramp(0.0, 0.3, layers * 1.4 - steps)
    tread = np.clip(steps + edge, -1, 6)
    height = top * (0.5 + 0.1 * tread) + 0.03 * rough
    light = (0.16 + 0.84 * top) * (0.72 + 0.07 * tread + 0.12 * (chips.draw - 0.5)) * (1 + 0.07 * rough)
    light *= 0.8 + 0.2 * edge
    fresh = np.clip(0.55 + 1.1 * (chips.draw - 0.5) + 0.22 * flakes, 0, 1) * top
    return Drawing(_tinted(light, fresh, (0.84, 1.0, 1.14), (1.13, 0.99, 0.85)), 0.016 * height, 0.92 - 0.12 * top)


def smooth(n: int) -> Drawing:
    """Beech, hornbeam: nearly even, with faint wrinkles across, blotches and warts."""
    cloud, spots = fractal(n, 31, 14, 2, 1.0, 0.8), fractal(n, 32, 60, 8, 0.9)
    wrinkle, grain = fractal(n, 33, 120, 10, 0.8, 0.16), fractal(n, 34, 240, 40, 0.4)
    warts = cells(n, 34, 26, 35, (0.01 * spots, 0.01 * cloud), 1.0)
    wart = (1 - ramp(0.03, 0.13, warts.middle)) * (warts.draw > 0.72)
    blotch = ramp(0.3, 1.3, 0.7 * cloud + 0.7 * spots)
    height = 0.09 * wrinkle + 0.08 * spots + 0.4 * wart + 0.04 * grain
    light = 1 + 0.05 * cloud + 0.045 * wrinkle + 0.035 * grain + 0.13 * blotch - 0.2 * wart
    return Drawing(_tinted(light, blotch, (1.02, 1.0, 0.97), (0.95, 1.02, 1.0)), 0.0025 * height, 0.8 + 0.1 * blotch)


def ringed(n: int) -> Drawing:
    """Birch, cherry: a smooth skin with dark dashes across and edges where it peels."""
    cloud, grain = fractal(n, 41, 10, 2, 1.0, 2.0), fractal(n, 42, 200, 20, 0.6, 0.12)
    sway, rough = fractal(n, 43, 30, 3, 1.0), fractal(n, 44, 220, 30, 0.6)
    dash = _dashes(n, 8, 44, 45, sway, 0.3) + 0.75 * _dashes(n, 20, 90, 46, sway, 0.34)
    dash = np.clip(dash, 0, 1)
    peel = fractal(n, 47, 40, 3, 1.3, 0.14)
    edge = ramp(0.0, 0.04, np.abs(peel + 0.15 * cloud - 0.9)) * ramp(0.0, 0.04, np.abs(peel - 0.15 * cloud + 1.1))
    light = (1 + 0.05 * cloud + 0.045 * grain + 0.02 * rough) * (1 - 0.72 * dash) * (0.84 + 0.16 * edge)
    height = 0.12 * grain + 0.5 * dash + 0.4 * np.tanh(peel) + 0.3 * edge
    return Drawing(_tinted(light, dash, (1.0, 1.0, 1.0), (1.08, 0.98, 0.9)), 0.003 * height, 0.62 + 0.3 * dash)


def _dashes(n: int, columns: int, rows: int, seed: int, sway: Field, share: float) -> Field:
    """Dark dashes across, at most one in each cell, in a `share` of the cells."""
    own = cells(n, columns, rows, seed, (0 * sway, 0.004 * sway), 0.85)
    long = 0.12 + 0.5 * own.draw / share
    return np.asarray((1 - ramp(0.55, 1.0, own.middle / long)) * (own.draw < share), dtype=np.float32)


def _tinted(light: Field, share: Field, low: tuple[float, float, float], high: tuple[float, float, float]) -> Colours:
    """Colours (n, n, 3): `light` times a hue between `low` and `high` by `share`."""
    hue = np.array(low, np.float32) + share[..., None] * (np.array(high, np.float32) - np.array(low, np.float32))
    return np.asarray(np.maximum(light, 0.03)[..., None] * hue, dtype=np.float32)


_KINDS = {"furrowed": furrowed, "plated": plated, "smooth": smooth, "ringed": ringed}
_FINEST = 256  # pixels a metre under which furrows would be lost; smaller textures are drawn at more


@cache
def bark_textures(kind: str, size: int) -> Textures:
    """Return the textures (size, size) of a square metre of `kind`: furrowed, plated, smooth or ringed."""
    finer = -(-_FINEST // size)
    drawn = _KINDS[kind](size * finer)
    return textures_of(drawn if finer == 1 else drawn.coarser(finer))
