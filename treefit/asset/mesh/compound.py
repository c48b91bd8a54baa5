"""Compound leaves: leaflets of two triangles in pairs along a stalk, one more at its tip, as of ash or rowan."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

PAIRS = 4
_FIRST, _LAST = 0.13, 0.70  # places of the lowest and the highest pair along the stalk
_LONG, _WIDE, _TURN = 0.34, 0.17, 0.55  # of a leaflet; rad it leans to the tip, before widths are scaled
_STALK = 0.012  # half width


def leaflets() -> tuple[Floats, Floats, Floats]:
    """Base (n, 2), tip (n, 2) and half width (n,) of the leaflets of a leaf that is to be scaled across."""
    at = np.repeat(np.linspace(_FIRST, _LAST, PAIRS), 2)
    side = np.tile([1.0, -1.0], PAIRS)
    long = _LONG * np.sin(np.pi * (0.36 + 0.3 * np.linspace(0, 1, PAIRS).repeat(2)))
    base = np.r_[np.column_stack([0 * at, at]), [[0.0, 0.72]]]
    way = np.column_stack([side * math.cos(_TURN), np.full_like(at, math.sin(_TURN))])
    tip = np.r_[base[:-1] + long[:, None] * way, [[0.0, 1.0]]]
    return base, tip, np.r_[long * _WIDE / _LONG / 2, 0.055]


def corners() -> Floats:
    """Places (c, 2): base, right, tip, left of every leaflet, then foot right, foot left and head of the stalk."""
    base, tip, wide = leaflets()
    way = (tip - base) / np.linalg.norm(tip - base, axis=1, keepdims=True)
    across = np.column_stack([way[:, 1], -way[:, 0]]) * wide[:, None]
    middle = base + 0.45 * (tip - base)
    kites = np.stack([base, middle + across, tip, middle - across], axis=1).reshape(-1, 2)
    place = np.concatenate([kites, [[_STALK, 0.0], [-_STALK, 0.0], [0.0, 0.74]]])
    place[:, 0] *= math.pi / 4 / _area(place)
    return place


def compound(turn: float) -> tuple[Floats, Floats, Floats, NDArray[np.int64]]:
    """Places (c, 3), unit normals (c, 3), flat places (c, 2) and triangles (t, 3); halves are raised by `turn` rad."""
    flat = corners()
    x, y = flat.T
    side = np.sign(x)
    side[-3:] = 0  # the stalk is not folded
    cosine = np.where(side == 0, 1.0, math.cos(turn))
    place = np.column_stack([x * cosine, y, np.abs(side * x) * math.sin(turn)])
    normal = np.column_stack([-side * math.sin(turn), 0 * x, cosine])
    return place, normal, flat, _faces()


def _faces() -> NDArray[np.int64]:
    first = 4 * np.arange(2 * PAIRS + 1)[:, None]
    stalk = 4 * (2 * PAIRS + 1) + np.array([[0, 2, 1]])
    return np.concatenate([first + np.array([0, 1, 2]), first + np.array([0, 2, 3]), stalk])


def _area(place: Floats) -> float:
    a, b, c = place[_faces()].transpose(1, 0, 2)
    one, other = b - a, c - a
    return float(np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).sum() / 2)
