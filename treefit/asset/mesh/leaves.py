"""Leaves: the leaves of a plant as folded cards, in the plant's own frame (z up, metres)."""

from __future__ import annotations

import numpy as np

from treefit.asset.mesh.leaf_outline import leaf_card
from treefit.asset.mesh.mesh import Mesh, unit
from treefit.plant import LeafShape, Plant


def leaf_mesh(plant: Plant, shape: LeafShape = "broad", fold: float = 0.0) -> Mesh:
    """Return the leaves as cards, each of area pi/4 * length * width, with halves raised by `fold` degrees."""
    card = leaf_card(shape, fold)
    k, corners = plant.n_leaves, len(card.place)
    axis = np.asarray(plant.leaf_axis, dtype=np.float32)
    normal = np.asarray(plant.leaf_normal, dtype=np.float32)
    across = np.cross(axis, normal)
    frame = np.stack([across, axis, normal], axis=1)  # (k, 3, 3), rows are the card's x, y, z
    length, width = plant.leaf_size[:, :1], plant.leaf_size[:, 1:]
    stretch = np.concatenate([width, length, width], axis=1)
    vertices = np.matmul(card.place[None] * stretch[:, None], frame) + plant.leaf_position[:, None]
    normals = np.matmul(np.broadcast_to(card.normal, (k, corners, 3)), frame)
    faces = card.faces[None] + corners * np.arange(k, dtype=np.int32)[:, None, None]
    return Mesh(
        np.ascontiguousarray(vertices, dtype=np.float32).reshape(-1, 3),
        faces.astype(np.int32).reshape(-1, 3),
        unit(normals.reshape(-1, 3)),
        np.tile(card.uv, (k, 1)),
    )
