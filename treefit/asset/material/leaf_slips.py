"""Slips: the strokes that fronds, twigs of needles, sprays of scales and compound leaves are drawn with."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.asset.material.strokes import Profile, Strokes, layered
from treefit.asset.mesh.compound import corners
from treefit.asset.mesh.feather import Feather, frond, spray, tuft

Floats = NDArray[np.float64]
Point = NDArray[np.float64]  # (2,)

_LEAFLET: Profile = (
    (0.0, 0.06), (0.06, 0.3), (0.16, 0.66), (0.28, 0.9), (0.42, 1.0), (0.58, 0.9), (0.74, 0.62), (0.88, 0.27),
    (1.0, 0.0),
)  # fmt: skip
_SLIP: Profile = ((0.0, 0.6), (0.15, 0.95), (0.4, 1.0), (0.7, 0.7), (0.9, 0.3), (1.0, 0.0))
_NEEDLE: Profile = ((0.0, 0.8), (0.1, 1.0), (0.7, 0.9), (0.93, 0.5), (1.0, 0.0))
_SCALE: Profile = ((0.0, 0.45), (0.3, 1.0), (0.6, 0.85), (1.0, 0.0))
_HIGHEST = 0.96  # end of a twig whose last scales end at the tip of the leaf


@dataclass(frozen=True, eq=False)
class Slips:
    """How a leaf is drawn."""

    strokes: Strokes
    profile: Profile
    midrib: float  # width of the vein along each slip, by that of the slip
    veins: int = 0  # on either side of it


def _frond() -> Slips:
    """Two leaflets in each slip of the mesh."""
    low, high, tip = _ends(frond(0.0))
    draw, part = np.random.default_rng(71).random((2, len(tip))), (high - low)[:, 1]
    near, far = (low + share * (high - low) for share in (0.3, 0.74))
    lower = _leaves(near, near + 0.98 * (tip - near), 0.2 * part, 0.80 + 0.16 * draw[0])
    upper = _leaves(far, far + 0.84 * (tip - far), 0.2 * part, 0.94 + 0.16 * draw[1])
    end = _leaves(np.array([[0, 0.9]]), np.array([[0, 1.0]]), np.array([0.02]), np.array([1.0]))
    return Slips(layered([lower, upper, end, _stem(0.96, 0.016, 0.35, 1.0)]), _SLIP, 0.25)


def _tuft() -> Slips:
    """Needles along a twig, those behind darker."""
    _, _, tip = _ends(tuft())
    rng, count, leader = np.random.default_rng(72), 150, 9
    at = np.sort(rng.random(count) ** 0.9)
    up = np.clip(1.5 * at - 0.25, 0, 1)
    side = np.where(np.arange(count) % 2 == 0, 1.0, -1.0) * np.abs(tip[:, 0]).max()
    base = np.column_stack([0 * at, 0.7 * at])
    end = np.column_stack([side * (1 - 0.45 * up**2), 0.45 + 0.55 * up])
    end = base + (end - base) * rng.uniform(0.72, 1.0, (count, 1)) + rng.normal(0, 0.03, (count, 2))
    end[:, 0] *= np.where(rng.random(count) < 0.18, rng.random(count), 1.0)  # these point to or from the viewer
    end[-leader:] = np.column_stack([np.linspace(-0.3, 0.3, leader), rng.uniform(0.9, 1.0, leader)])
    order = rng.permutation(count)
    shade = np.linspace(0.5, 1.05, count) * rng.uniform(0.9, 1.1, count)
    needles = _leaves(base[order], end[order], np.full(count, 0.0115), shade)
    return Slips(layered([_stem(0.74, 0.02, 1.0, 0.8), needles]), _NEEDLE, 0.25)


def _scale() -> Slips:
    """Twigs that are covered with scales, a twig in each slip of the mesh, with smaller ones on either side."""
    low, high, tip = _ends(spray(0.0))
    rng = np.random.default_rng(73)
    parts = []
    for base, end in zip(0.5 * low + 0.5 * high, tip, strict=True):
        way, inner = end - base, -np.sign(end[0])
        for at, side in ((0.2, 1), (0.34, -1), (0.48, 1), (0.62, -1), (0.76, 1)):
            first = base + at * way
            last = first + _turned(way, 0.34 * side * inner) * (0.42 - 0.3 * at) * rng.uniform(0.85, 1.15)
            last[1] = min(last[1], _HIGHEST)
            parts.append(_scales(first, last, 0.021, rng))
        parts.append(_scales(base, base + 0.96 * way, 0.027, rng))
    parts.append(_scales(np.array([0.0, 0.0]), np.array([0.0, _HIGHEST + 0.02]), 0.032, rng))
    return Slips(layered(parts), _SCALE, 0.12)


def _compound() -> Slips:
    """A leaflet in each kite of the mesh, over them the stalk."""
    kites = corners()[:-3].reshape(-1, 4, 2)
    way, chord = kites[:, 2] - kites[:, 0], kites[:, 1] - kites[:, 3]
    wide = np.abs(way[:, 0] * chord[:, 1] - way[:, 1] * chord[:, 0]) / np.linalg.norm(way, axis=1) / 2
    shade = np.random.default_rng(74).uniform(0.9, 1.06, len(kites))
    leaflets = _leaves(kites[:, 0], kites[:, 2], 0.95 * wide, shade)
    return Slips(layered([leaflets, _stem(0.76, 0.016, 0.35, 1.0)]), _LEAFLET, 0.08, 8)


def _scales(base: Point, end: Point, wide: float, rng: np.random.Generator) -> Strokes:
    """Scales in threes along a twig from `base` to `end`: left, right and on top."""
    way = end - base
    long = float(np.linalg.norm(way))
    count = max(int(long / (0.8 * wide)), 2)
    at = np.repeat(np.arange(count) / count, 3)[:, None]
    side = np.tile([-1.0, 1.0, 0.0], count)[:, None]
    width = wide * (1 - 0.45 * at)
    out = side * np.array([way[1], -way[0]]) / long
    first = base + at * way + 0.25 * width * out
    shade = (0.74 + 0.32 * at[:, 0]) * rng.uniform(0.9, 1.1, 3 * count) * np.tile([0.9, 0.9, 1.1], count)
    return _leaves(first, first + width * (1.9 * way / long + 0.75 * out), 0.55 * width[:, 0], shade)


def _ends(feather: Feather) -> tuple[Floats, Floats, Floats]:
    """Lower and upper end at the midrib and tip (s, 2) of the slips, spread out flat."""
    flat = feather.corners()[2]
    low, high = (np.column_stack([0 * feather.turn, feather.midrib[feather.part + end]]) for end in (0, 1))
    return low, high, flat[len(feather.midrib) :]


def _leaves(base: Floats, tip: Floats, width: Floats, shade: Floats) -> Strokes:
    return Strokes(base, tip, width, shade, np.zeros(len(base)))


def _stem(long: float, width: float, wood: float, shade: float) -> Strokes:
    """Stalk or twig from the foot of the leaf on."""
    return Strokes(np.zeros((1, 2)), np.array([[0.0, long]]), *(np.array([one]) for one in (width, shade, wood)))


def _turned(way: Point, angle: float) -> Point:
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([way[0] * cosine - way[1] * sine, way[0] * sine + way[1] * cosine])


SLIPS: Mapping[str, Callable[[], Slips]] = {"frond": _frond, "tuft": _tuft, "scale": _scale, "compound": _compound}
