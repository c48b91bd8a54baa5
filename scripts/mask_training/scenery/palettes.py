"""Palettes: colours of leaves by season and of bark, as display values; a crown mixes those of its palette."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scripts.mask_training.scenery.arrays import Colour, Floats, Rng, chance, tinted

Bytes = tuple[int, int, int]


@dataclass(frozen=True)
class Bark:
    """Two colours that are mixed, how rough, and how dark the marks across it are (birch)."""

    light: Colour
    dark: Colour
    rough: float
    marks: float


GREENS: tuple[tuple[Bytes, ...], ...] = (
    ((92, 124, 48), (120, 148, 62), (74, 104, 40)),
    ((70, 104, 44), (98, 130, 56), (60, 88, 38)),
    ((56, 92, 48), (84, 118, 60)),
    ((110, 140, 60), (140, 164, 76), (90, 120, 50)),
    ((126, 160, 54), (104, 140, 44)),
    ((80, 100, 52), (108, 122, 66), (96, 110, 50)),
    ((96, 132, 72), (122, 152, 92)),
    ((60, 82, 40), (80, 98, 46), (104, 112, 60)),
)  # fmt: skip
SPRING: tuple[tuple[Bytes, ...], ...] = (
    ((150, 172, 70), (172, 186, 90), (128, 152, 60)),
    ((168, 172, 84), (140, 160, 62)),
    ((176, 160, 96), (150, 164, 76), (190, 150, 90)),
)
AUTUMN: tuple[tuple[Bytes, ...], ...] = (
    ((214, 168, 30), (228, 190, 56), (190, 140, 34)),
    ((206, 96, 30), (222, 130, 36), (180, 66, 30)),
    ((190, 50, 34), (214, 82, 30), (150, 36, 30)),
    ((222, 180, 40), (206, 110, 34), (110, 130, 50)),
    ((150, 104, 52), (176, 130, 66), (120, 80, 44)),
    ((196, 160, 50), (120, 136, 54), (170, 176, 70)),
    ((176, 80, 40), (200, 140, 50), (96, 104, 48)),
    ((132, 84, 50), (160, 60, 40), (186, 120, 44)),
)
CONIFER: tuple[tuple[Bytes, ...], ...] = (
    ((54, 78, 44), (74, 98, 54), (42, 64, 38)),
    ((70, 96, 84), (104, 128, 116), (60, 84, 70)),
    ((96, 118, 108), (130, 150, 140)),
    ((86, 108, 46), (112, 130, 56), (66, 88, 40)),
    ((40, 58, 38), (58, 76, 46)),
    ((120, 120, 50), (150, 140, 60), (96, 98, 44)),
    ((110, 100, 58), (90, 88, 48), (130, 110, 66)),
    ((64, 92, 60), (90, 118, 76)),
)
BLOSSOM: tuple[tuple[Bytes, ...], ...] = (
    ((240, 232, 232), (250, 246, 244), (216, 206, 206), (150, 164, 90)),
    ((236, 190, 206), (246, 216, 226), (220, 160, 184)),
    ((214, 130, 166), (232, 166, 190), (190, 110, 140)),
    ((230, 214, 120), (190, 190, 90)),
    ((190, 150, 206), (170, 130, 190)),
)
PURPLE: tuple[tuple[Bytes, ...], ...] = (
    ((84, 40, 46), (110, 54, 56), (70, 36, 44)),
    ((104, 50, 40), (74, 40, 40), (90, 70, 46)),
)
SILVER: tuple[tuple[Bytes, ...], ...] = (
    ((138, 150, 124), (164, 172, 150), (116, 130, 102)),
    ((120, 140, 110), (150, 160, 130)),
)
SEASONS: dict[str, tuple[tuple[tuple[Bytes, ...], ...], float]] = {
    "green": (GREENS, 0.50), "spring": (SPRING, 0.10), "autumn": (AUTUMN, 0.23), "blossom": (BLOSSOM, 0.07),
    "purple": (PURPLE, 0.05), "silver": (SILVER, 0.05),
}  # fmt: skip
BARKS: tuple[tuple[Bark, float], ...] = (
    (Bark((0.48, 0.43, 0.38), (0.30, 0.26, 0.22), 0.7, 0.0), 4.0),  # grey brown
    (Bark((0.42, 0.33, 0.25), (0.24, 0.18, 0.13), 0.8, 0.0), 3.0),  # brown
    (Bark((0.55, 0.54, 0.51), (0.40, 0.39, 0.37), 0.35, 0.1), 3.0),  # smooth grey
    (Bark((0.26, 0.22, 0.19), (0.13, 0.11, 0.10), 0.8, 0.0), 3.0),  # dark
    (Bark((0.86, 0.84, 0.80), (0.66, 0.63, 0.58), 0.2, 0.9), 1.2),  # birch
    (Bark((0.74, 0.70, 0.60), (0.52, 0.50, 0.40), 0.35, 0.3), 1.2),  # plane, eucalypt
    (Bark((0.56, 0.43, 0.33), (0.40, 0.29, 0.21), 0.7, 0.0), 1.0),  # red of pines
    (Bark((0.46, 0.47, 0.36), (0.30, 0.31, 0.22), 0.5, 0.0), 1.0),  # with moss
    (Bark((0.66, 0.58, 0.48), (0.46, 0.38, 0.30), 0.5, 0.0), 1.2),  # pale brown, lit
)


def drawn_season(rng: Rng) -> str:
    """Name of a season of a broadleaf tree."""
    share = np.array([share for _, share in SEASONS.values()])
    return str(rng.choice(list(SEASONS), p=share / share.sum()))


def drawn_palette(season: str, conifer: bool, rng: Rng) -> Floats:
    """Colours (m, 3) that the leaves of one crown mix."""
    if conifer and not (season == "autumn" and chance(rng, 0.1)):
        kinds = CONIFER
    else:
        kinds, _ = SEASONS[season]
    colours = np.array(kinds[int(rng.integers(len(kinds)))], np.float32) / 255
    tone = np.exp(rng.normal(0, 0.12)) * np.exp(rng.normal(0, 0.07, 3))
    palette: Floats = np.clip(colours * tone, 0.01, 0.98).astype(np.float32)
    if chance(rng, 0.15):  # between two seasons, or of two kinds of leaves
        others = SEASONS[drawn_season(rng)][0]
        palette = np.vstack([palette, np.array(others[int(rng.integers(len(others)))][:1], np.float32) / 255])
    return palette


def drawn_bark(rng: Rng) -> Bark:
    """A bark of chance."""
    share = np.array([share for _, share in BARKS])
    bark = BARKS[int(rng.choice(len(BARKS), p=share / share.sum()))][0]
    light = tinted(bark.light, rng, 0.12)
    dark = tuple(float(a * b / max(c, 0.01)) for a, b, c in zip(light, bark.dark, bark.light, strict=True))
    return Bark(
        light, (dark[0], dark[1], dark[2]), bark.rough * rng.uniform(0.6, 1.3), bark.marks * rng.uniform(0.6, 1.2)
    )
