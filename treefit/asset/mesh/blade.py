"""Blades: leaves of one piece, two fans from the stalk, one a half."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from treefit.plant.look import SPRIGS

Floats = NDArray[np.float64]

# Right half from the stalk to the tip: (half width, place along the midrib); seen from the stalk the points turn
# steadily towards the tip, so a fan from the stalk covers the half. Widths are scaled to the area of the ellipse.
_HALVES: Mapping[str, tuple[tuple[float, float], ...]] = {
    "broad": ((0.46, 0.22), (0.42, 0.62)),
    "round": ((0.34, 0.07), (0.50, 0.42), (0.38, 0.82)),
    "narrow": ((0.40, 0.30), (0.34, 0.55)),
    "lobed": ((0.38, 0.03), (0.33, 0.25), (0.52, 0.58), (0.28, 0.66)),
    "oak": ((0.29, 0.22), (0.24, 0.36), (0.42, 0.65), (0.27, 0.73), (0.24, 0.93)),
    "needle": ((0.50, 0.40),),
    **dict.fromkeys(SPRIGS.values(), ((0.57, 0.23), (0.49, 0.72))),
}
BLADES = frozenset(_HALVES)


def half_of(shape: str) -> Floats:
    """Corners (n, 2) of the right half of a blade of area pi/4, from the stalk to the tip without these two."""
    return np.array(_HALVES[shape]) * [area_scale(shape), 1]


def area_scale(shape: str) -> float:
    """By what the widths that are written here are scaled."""
    return math.pi / 8 / _area(np.array(_HALVES[shape]))


def blade(shape: str, turn: float) -> tuple[Floats, Floats, Floats, NDArray[np.int64]]:
    """Places (c, 3), unit normals (c, 3), flat places (c, 2) and triangles (t, 3); halves are raised by `turn` rad."""
    half = half_of(shape)
    n = len(half)
    x = np.concatenate([[0, 0], half[:, 0], -half[:, 0]])
    y = np.concatenate([[0, 1], half[:, 1], half[:, 1]])
    place = np.column_stack([x * math.cos(turn), y, np.abs(x) * math.sin(turn)])
    normal = np.column_stack([-np.sign(x) * math.sin(turn), 0 * x, np.where(x == 0, 1, math.cos(turn))])
    right, left = [*range(2, 2 + n), 1], [*range(2 + n, 2 + 2 * n), 1]
    faces = [(0, a, b) for a, b in pairwise(right)] + [(0, b, a) for a, b in pairwise(left)]
    return place, normal, np.column_stack([x, y]), np.array(faces)


def _area(half: Floats) -> float:
    """Area of the polygon stalk, points of `half` (n, 2), tip."""
    x = np.concatenate([[0], half[:, 0], [0]])
    y = np.concatenate([[0], half[:, 1], [1]])
    return abs(float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))) / 2
