"""Model: stems and leaves of a tree one unit high at the origin, z up; knows no picture."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from scripts.mask_training.scenery.arrays import Floats, Rng
from treefit.plant import Plant


@dataclass(frozen=True, eq=False)
class Model:
    """Lengths in heights of the tree; the foot of the trunk is the origin."""

    stem_from: Floats  # (n, 3)
    stem_to: Floats  # (n, 3)
    radius_from: Floats  # (n,)
    radius_to: Floats  # (n,)
    leaf_place: Floats  # (k, 3), the middle
    leaf_axis: Floats  # (k, 3) unit
    leaf_normal: Floats  # (k, 3) unit, where light and shade turn
    leaf_size: Floats  # (k, 2) length, width
    conifer: bool = False

    @property
    def n_leaves(self) -> int:
        """Count of leaves."""
        return len(self.leaf_place)


def model_of(plant: Plant, conifer: bool) -> Model:
    """The plant of a generator as a model."""
    child = np.arange(1, plant.n_vertices)
    parent = plant.parent[1:]
    place, leaf = plant.position.astype(np.float32), plant.leaf_position
    top = max(float(place[:, 2].max()), float(leaf[:, 2].max(initial=0.0)), 1e-3)
    begins = plant.level[1:] > plant.level[parent]
    first = np.where(begins, plant.radius[1:], plant.radius[parent])
    middle = leaf + plant.leaf_axis * plant.leaf_size[:, :1] * 0.5
    return Model(
        place[parent] / top, place[child] / top, (first / top).astype(np.float32),
        (plant.radius[1:] / top).astype(np.float32), (middle / top).astype(np.float32),
        plant.leaf_axis.astype(np.float32), plant.leaf_normal.astype(np.float32),
        (plant.leaf_size / top).astype(np.float32), conifer,
    )  # fmt: skip


def leafier(model: Model, cover: float, most: int, rng: Rng) -> Model:
    """The model with more, larger or fewer leaves: their area is then about `cover` times what the crown shows.

    New leaves stand in tufts around the old ones, as on twigs that are too fine to be modelled.
    """
    k = model.n_leaves
    if k == 0:
        return model
    low, high = np.quantile(model.leaf_place, (0.05, 0.95), axis=0)
    spread = high - low
    shown = max(float(spread[2] * max(spread[0], spread[1])), 0.02)
    area = float(model.leaf_size.prod(axis=1).sum()) * 0.5
    wanted = cover * shown / max(area, 1e-6)
    copies = int(np.clip(np.ceil(wanted / 1.6), 1, max(1, most // k)))
    scale = float(np.clip(np.sqrt(wanted / copies), 0.5, 3.0))
    size = model.leaf_size * scale
    rows = np.repeat(np.arange(k), copies)
    if len(rows) > most:
        rows = rng.choice(rows, most, replace=False)
        size = size * np.sqrt(k * copies / most)
    long = float(np.clip(np.median(size[:, 0]), 0.004, 0.03))
    away = rng.standard_normal((len(rows), 3), dtype=np.float32) * (long * 0.9 if copies > 1 else 0.0)
    turn = rng.standard_normal((len(rows), 3), dtype=np.float32) * (0.5 if copies > 1 else 0.0)
    return replace(
        model, leaf_place=model.leaf_place[rows] + away, leaf_axis=unit(model.leaf_axis[rows] + turn),
        leaf_normal=unit(model.leaf_normal[rows] + turn[:, ::-1]), leaf_size=np.clip(size[rows], 0.003, 0.11),
    )  # fmt: skip


def bare(model: Model) -> Model:
    """The model without leaves."""
    none = np.zeros((0, 3), np.float32)
    return replace(model, leaf_place=none, leaf_axis=none, leaf_normal=none, leaf_size=none[:, :2])


def unit(vectors: Floats) -> Floats:
    """`vectors` (n, 3) of length 1."""
    length: Floats = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))[:, None]
    scaled: Floats = vectors / np.maximum(length, np.float32(1e-6))
    return scaled
