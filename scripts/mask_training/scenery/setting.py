"""Setting: weather, season and light of a scene, which all that is painted has in common."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scripts.mask_training.scenery.arrays import Colour, Rng, chance
from scripts.mask_training.scenery.light import Light, sunlight

WEATHERS = {"clear": 0.38, "cloudy": 0.25, "overcast": 0.22, "haze": 0.06, "dusk": 0.06, "storm": 0.03}
GROUNDS = {
    "lawn": 0.50, "meadow": 0.16, "snow": 0.08, "road": 0.08, "gravel": 0.05, "soil": 0.05, "water": 0.03, "dry": 0.05,
}  # fmt: skip
"""Shares of weathers, and of what the ground is of."""


@dataclass(frozen=True)
class Setting:
    """What a scene is painted with; `horizon` is a row, `haze` the share of air before what is far."""

    weather: str
    ground: str
    season: str
    horizon: float
    light: Light
    air: Colour
    haze: float
    shade: float  # display value of what is lit evenly, against that in a plain day

    @property
    def sunny(self) -> bool:
        """Whether there are hard shadows."""
        return self.light.strength > 0.45


def drawn_setting(season: str, size: int, rng: Rng) -> Setting:
    """A setting of chance for a tree in `season`."""
    weather = _one_of(WEATHERS, rng)
    ground = "snow" if season == "snow" and chance(rng, 0.8) else _one_of(GROUNDS, rng)
    if season in ("green", "blossom", "spring") and ground == "snow":
        ground = "lawn"
    horizon = size * float(np.clip(rng.normal(0.74, 0.1), 0.42, 0.97))
    strength = {
        "clear": rng.uniform(0.6, 1.0), "cloudy": rng.uniform(0.3, 0.95), "overcast": rng.uniform(0.0, 0.2),
        "haze": rng.uniform(0.1, 0.5), "dusk": rng.uniform(0.0, 0.7), "storm": rng.uniform(0.1, 0.9),
    }[weather]  # fmt: skip
    brightness = rng.uniform(0.38, 0.66) if strength > 0.4 else rng.uniform(0.26, 0.55)
    if weather == "dusk":
        brightness = rng.uniform(0.03, 0.4)
    elif chance(rng, 0.06):
        brightness = rng.uniform(0.08, 0.22)  # against the light
    light = sunlight(rng, strength, brightness, low=weather == "dusk" or chance(rng, 0.12))
    grey = rng.uniform(0.72, 0.92)
    blue = rng.uniform(0.0, 0.1)
    air = (grey - blue, grey, grey + 0.6 * blue)
    if weather == "dusk":
        air = (rng.uniform(0.5, 0.95), rng.uniform(0.4, 0.65), rng.uniform(0.35, 0.65))
    haze = rng.uniform(0.3, 0.7) if weather == "haze" else rng.uniform(0.0, 0.35)
    shade = float(np.clip(light.brightness / 0.48, 0.15, 1.25)) ** 0.8
    return Setting(weather, ground, season, horizon, light, air, haze, shade)


def _one_of(shares: dict[str, float], rng: Rng) -> str:
    share = np.array(list(shares.values()))
    return str(rng.choice(list(shares), p=share / share.sum()))
