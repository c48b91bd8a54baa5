"""Leaves: the leaves of a plant as folded cards, in the plant's own frame (z up, metres)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from treefit.asset.mesh.hanging import hanging_of
from treefit.asset.mesh.leaf_outline import Card, leaf_card
from treefit.asset.mesh.mesh import Mesh, unit
from treefit.asset.mesh.openness import Crown, outward_of
from treefit.asset.mesh.stems import Stems
from treefit.asset.mesh.wind import sway
from treefit.plant import LeafShape, Plant

Floats = NDArray[np.float32]

_SOFT = 0.62  # share of the crown in the normals of leaves


def leaf_mesh(
    plant: Plant, shape: LeafShape = "broad", fold: float = 0.0, stems: Stems | None = None, crown: Crown | None = None
) -> Mesh:
    """Return the leaves as cards, each of area pi/4 * length * width, with halves raised by `fold` degrees.

    With `stems` leaves follow the curves of their stems and know the wind. With a `crown` they are lit as one volume:
    each shows its front to the outside of the crown, with a normal that is bent there.
    """
    card = leaf_card(shape, fold)
    seat, wind = plant.leaf_position, None
    if stems is not None and len(stems):
        hanging = hanging_of(plant, stems)
        seat = (seat + hanging.moved).astype(np.float32)
        bend, phase = sway(stems)
        wind = _wind(hanging.of(bend), phase[hanging.ring], card)
    vertices, normals = _laid(plant, card, seat)
    faces = np.broadcast_to(card.faces, (plant.n_leaves, *card.faces.shape))
    if crown is not None:
        normals, faces = _turned_out(crown, vertices, normals, faces)
    faces = faces + len(card.place) * np.arange(plant.n_leaves, dtype=np.int32)[:, None, None]
    return Mesh(
        vertices.reshape(-1, 3), faces.astype(np.int32).reshape(-1, 3), unit(normals.reshape(-1, 3)),
        np.tile(card.uv, (plant.n_leaves, 1)), wind,
    )  # fmt: skip


def _laid(plant: Plant, card: Card, seat: Floats) -> tuple[Floats, Floats]:
    """Corners and normals (k, c, 3) of the card at every leaf."""
    axis = np.asarray(plant.leaf_axis, dtype=np.float32)
    normal = np.asarray(plant.leaf_normal, dtype=np.float32)
    frame = np.stack([np.cross(axis, normal), axis, normal], axis=1)  # (k, 3, 3), rows are the card's x, y, z
    length, width = plant.leaf_size[:, :1], plant.leaf_size[:, 1:]
    stretch = np.concatenate([width, length, width], axis=1)
    vertices = np.matmul(card.place[None] * stretch[:, None], frame) + seat[:, None]
    normals = np.matmul(np.broadcast_to(card.normal, (plant.n_leaves, *card.normal.shape)), frame)
    return np.ascontiguousarray(vertices, dtype=np.float32), normals


def _turned_out(
    crown: Crown, vertices: Floats, normals: Floats, faces: NDArray[np.int32]
) -> tuple[Floats, NDArray[np.int32]]:
    """Normals bent outward, and faces turned over whose back was outside: renderers turn the normals of backs."""
    middle = vertices.mean(axis=1)
    outward = outward_of(crown, middle)
    inward = np.einsum("ij,ij->i", normals.mean(axis=1), outward) < 0
    own = np.where(inward[:, None, None], -normals, normals)
    bent = (1 - _SOFT) * own + _SOFT * outward[:, None]
    return bent, np.where(inward[:, None, None], faces[:, :, ::-1], faces)


def _wind(bend: NDArray[np.float64], phase: NDArray[np.float64], card: Card) -> Floats:
    """Wind (k * c, 3) of leaves (k,): each sways as its seat, and flutters from its stalk to its tip and edges."""
    reach = np.hypot(card.place[:, 0], card.place[:, 1])
    flutter = reach / max(float(reach.max()), 1e-6)
    k, c = len(bend), len(flutter)
    wind = np.column_stack([np.repeat(bend, c), np.repeat(phase, c), np.tile(flutter, k)])
    return wind.astype(np.float32)
