"""Leaf outlines: one card in the unit square that is laid on every leaf of a plant."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, cast

import numpy as np
from numpy.typing import NDArray

from treefit.asset.mesh.feather import Feather, frond, tuft
from treefit.plant import LEAF_SHAPES, LeafShape, Look
from treefit.plant.look import leaf_shape_of

Outline = Literal["auto", LeafShape]

# Right half from the stalk to the tip: (half width, place along the midrib); seen from the stalk the points turn
# steadily towards the tip, so a fan from the stalk covers the half. Widths are scaled to the area of the ellipse.
_HALVES: dict[str, tuple[tuple[float, float], ...]] = {
    "broad": ((0.46, 0.22), (0.42, 0.62)),
    "round": ((0.34, 0.07), (0.50, 0.42), (0.38, 0.82)),
    "narrow": ((0.40, 0.30), (0.34, 0.55)),
    "lobed": ((0.40, 0.03), (0.25, 0.24), (0.52, 0.52), (0.18, 0.60)),
    "needle": ((0.50, 0.40),),
}


@dataclass(frozen=True, eq=False)
class Card:
    """One leaf of length 1 and width 1: x across, y from the stalk to the tip, z along its normal."""

    place: NDArray[np.float32]  # (c, 3)
    normal: NDArray[np.float32]  # (c, 3) unit
    uv: NDArray[np.float32]  # (c, 2) in [0, 1]
    faces: NDArray[np.int32]  # (t, 3)


def outline_of(wanted: Outline, look: Look | None) -> LeafShape:
    """Return the outline that is `wanted`; "auto" is that of the plant's look, "broad" when it has none."""
    return cast(LeafShape, leaf_shape_of(wanted, look))


def leaf_card(shape: LeafShape, fold: float = 0.0) -> Card:
    """Return the card of `shape` with area pi/4, its halves raised by `fold` degrees along the midrib.

    The needles of a tuft stand all around its twig, fold or not.
    """
    if shape not in LEAF_SHAPES:
        raise ValueError(f"leaf outline must be one of {', '.join(LEAF_SHAPES)}, got {shape!r}")
    if not 0 <= fold < 80:
        raise ValueError(f"leaf fold must be in [0, 80) degrees, got {fold}")
    turn = math.radians(fold)
    if shape == "tuft":
        return _feathered(tuft())
    if shape == "frond":
        return _feathered(frond(turn))
    return _blade(np.array(_HALVES[shape]), turn)


def _feathered(feather: Feather) -> Card:
    place, normal, uv = (part.astype(np.float32) for part in feather.corners())
    return Card(place, normal, uv, feather.faces().astype(np.int32))


def _blade(half: NDArray[np.float64], turn: float) -> Card:
    """Two fans from the stalk, one a half."""
    half[:, 0] *= math.pi / 8 / _half_area(half)
    n = len(half)
    x = np.concatenate([[0, 0], half[:, 0], -half[:, 0]])
    y = np.concatenate([[0, 1], half[:, 1], half[:, 1]])
    place = np.column_stack([x * math.cos(turn), y, np.abs(x) * math.sin(turn)])
    normal = np.column_stack([-np.sign(x) * math.sin(turn), 0 * x, np.where(x == 0, 1, math.cos(turn))])
    uv = np.column_stack([0.5 + x / (2 * np.abs(x).max()), y])
    right = [2 + i for i in range(n)] + [1]
    left = [2 + n + i for i in range(n)] + [1]
    faces = [(0, a, b) for a, b in pairwise(right)]
    faces += [(0, b, a) for a, b in pairwise(left)]
    return Card(
        place.astype(np.float32), normal.astype(np.float32), uv.astype(np.float32),
        np.array(faces, dtype=np.int32),
    )  # fmt: skip


def _half_area(half: NDArray[np.float64]) -> float:
    """Area of the polygon stalk, points of `half` (n, 2), tip."""
    x = np.concatenate([[0], half[:, 0], [0]])
    y = np.concatenate([[0], half[:, 1], [1]])
    return abs(float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))) / 2
