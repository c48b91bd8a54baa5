"""Leaf outlines: one card of length and width 1 that is laid on every leaf of a plant."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, cast

import numpy as np
from numpy.typing import NDArray

from treefit.asset.mesh.blade import BLADES, blade
from treefit.asset.mesh.compound import compound
from treefit.asset.mesh.feather import Feather, frond, spray, tuft
from treefit.asset.mesh.leaf_frame import LeafFrame
from treefit.plant import LEAF_SHAPES, LeafShape, Plant
from treefit.plant.leaf_shape import leaf_shape_of

Outline = Literal["auto", LeafShape]
Floats = NDArray[np.float64]
Corners = tuple[Floats, Floats, Floats, NDArray[np.int64]]


@dataclass(frozen=True, eq=False)
class Card:
    """One leaf of length 1 and width 1: x across, y from the stalk to the tip, z along its normal."""

    place: NDArray[np.float32]  # (c, 3)
    normal: NDArray[np.float32]  # (c, 3) unit
    uv: NDArray[np.float32]  # (c, 2) in [0, 1]
    faces: NDArray[np.int32]  # (t, 3)


def outline_of(wanted: Outline, plant: Plant) -> LeafShape:
    """Return the outline that is `wanted`; "auto" is that of the plant's look, else by the size of its leaves."""
    return cast(LeafShape, leaf_shape_of(wanted, plant))


def leaf_card(shape: LeafShape, fold: float = 0.0) -> Card:
    """Return the card of `shape` with area pi/4, its halves raised by `fold` degrees along the midrib.

    The needles of a tuft stand all around its twig, fold or not.
    """
    if not 0 <= fold < 80:
        raise ValueError(f"leaf fold must be in [0, 80) degrees, got {fold}")
    place, normal, flat, faces = _corners(shape, math.radians(fold))
    return _card(place, normal, LeafFrame(float(np.abs(flat[:, 0]).max())).uv(*flat.T), faces)


def plain_card(shape: LeafShape) -> Card:
    """Return the same leaf as two triangles that carry the whole texture, whose alpha is then the outline."""
    uv = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    flat = leaf_frame(shape).xy(uv)
    place, normal = np.column_stack([flat, np.zeros(4)]), np.tile([0.0, 0.0, 1.0], (4, 1))
    return _card(place, normal, uv, np.array([[0, 1, 2], [0, 2, 3]]))


def leaf_frame(shape: LeafShape) -> LeafFrame:
    """Return the square that the texture of `shape` fills."""
    return LeafFrame(float(np.abs(_corners(shape, 0.0)[2][:, 0]).max()))


def _corners(shape: LeafShape, turn: float) -> Corners:
    """Places, normals, flat places and triangles of `shape`, halves raised by `turn` rad."""
    if shape not in LEAF_SHAPES:
        raise ValueError(f"leaf outline must be one of {', '.join(LEAF_SHAPES)}, got {shape!r}")
    if shape in BLADES:
        return blade(shape, turn)
    if shape == "compound":
        return compound(turn)
    return _feathered({"tuft": tuft, "frond": lambda: frond(turn), "scale": lambda: spray(turn)}[shape]())


def _feathered(feather: Feather) -> Corners:
    return *feather.corners(), feather.faces()


def _card(place: Floats, normal: Floats, uv: Floats, faces: NDArray[np.int64]) -> Card:
    return Card(
        place.astype(np.float32), normal.astype(np.float32), uv.astype(np.float32), faces.astype(np.int32)
    )  # fmt: skip
