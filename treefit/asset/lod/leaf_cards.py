"""Leaf cards: leaves of one or two triangles, with the texture's alpha as outline and the light of the whole ones."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from treefit.asset.lod.leaf_shown import shown
from treefit.asset.lod.silhouette import holes
from treefit.asset.material.material import Material
from treefit.asset.mesh.leaf_outline import Card, leaf_card, plain_card
from treefit.asset.mesh.mesh import Mesh
from treefit.asset.model import Part
from treefit.plant import LeafShape, Plant

Floats = NDArray[np.float32]
Ints = NDArray[np.int64]
_MIDDLE = np.array([0, 0.5, 0], dtype=np.float32)
_TEXELS = 128  # of a texture's side that are looked at


@dataclass(frozen=True, eq=False)
class LeafForms:
    """The leaves (k,) of a plant as they are in the whole model, and the simpler forms that each can have."""

    plant: Plant
    whole: Mesh
    moved: Floats  # (k, 3) m, from where the plant has a leaf to where the whole model has it
    turned: NDArray[np.bool_]  # (k,) whose faces are turned over
    card: Card  # two triangles
    slip: Card  # one triangle, as large in area

    @property
    def faces_each(self) -> int:
        """Triangles of a leaf of the whole model."""
        return len(self.whole.faces) // self.plant.n_leaves

    def wholes(self, index: Ints) -> Mesh:
        """Leaves `index` (n,) as in the whole model."""
        corners, faces = len(self.whole.vertices) // self.plant.n_leaves, self.faces_each
        at = (index[:, None] * corners + np.arange(corners)).ravel()
        own = self.whole.faces.reshape(-1, faces, 3)[index] - (index * corners)[:, None, None]
        return self._mesh(at, self.whole.vertices[at], self.whole.uv[at], own, corners)

    def simple(self, form: Card, index: Ints, size: Floats) -> Mesh:
        """Leaves `index` (n,) in the simpler `form`, enlarged by `size` (n,) around their middle.

        Normals, wind and openness are those of the corner of the same leaf that is nearest in the texture.
        """
        corners = len(self.whole.vertices) // self.plant.n_leaves
        apart = np.linalg.norm(self.whole.uv[None, :corners] - form.uv[:, None], axis=2)
        at = (index[:, None] * corners + apart.argmin(axis=1)[None]).ravel()
        frame, stretch = _frames(self.plant, index)
        stretch = stretch * size[:, None]
        middle = self.plant.leaf_position[index] + self.moved[index]
        middle = middle + self.plant.leaf_axis[index] * self.plant.leaf_size[index, :1] / 2
        place = np.matmul((form.place - _MIDDLE)[None] * stretch[:, None], frame) + middle[:, None]
        own = np.where(self.turned[index, None, None], form.faces[None, :, ::-1], form.faces[None])
        return self._mesh(at, place.reshape(-1, 3), np.tile(form.uv, (len(index), 1)), own, len(form.place))

    def _mesh(self, at: Ints, place: Floats, uv: Floats, faces: NDArray[np.int32], corners: int) -> Mesh:
        whole = self.whole
        faces = faces + corners * np.arange(len(faces))[:, None, None]
        return Mesh(
            np.ascontiguousarray(place, dtype=np.float32), faces.astype(np.int32).reshape(-1, 3), whole.normals[at], uv,
            None if whole.wind is None else whole.wind[at], None if whole.openness is None else whole.openness[at],
        )  # fmt: skip


def leaf_forms(plant: Plant, whole: Part, shape: LeafShape, fold: float) -> LeafForms:
    """Return the forms of the leaves that `whole` has as `shape` with halves raised by `fold` degrees."""
    own, everything = leaf_card(shape, fold), np.arange(plant.n_leaves)
    corners, faces = len(own.place), len(own.faces)
    frame, stretch = _frames(plant, everything)
    stalk = np.matmul((own.place[:1][None] * stretch[:, None]), frame)[:, 0] + plant.leaf_position
    turned = whole.mesh.faces.reshape(-1, faces, 3)[:, 0, 0] - everything * corners != own.faces[0, 0]
    card = plain_card(shape) if _has_holes(whole.material) else _rhomb()
    width = float(plant.leaf_size[:, 1].sum() / max(plant.leaf_size[:, 0].sum(), 1e-12))
    card, slip = (_as_large(form, own, width, whole) for form in (card, _slip(card, whole.material)))
    return LeafForms(plant, whole.mesh, whole.mesh.vertices[::corners] - stalk, turned, card, slip)


def _as_large(form: Card, own: Card, width: float, whole: Part) -> Card:
    """Return `form` enlarged around its middle so that it covers as much as the leaf's `own` form does."""
    alpha, cutoff = holes(whole)
    covered = [shown(card, width, alpha, cutoff) for card in (own, form)]
    place = (form.place - _MIDDLE) * np.float32(math.sqrt(covered[0] / max(covered[1], 1e-6))) + _MIDDLE
    return replace(form, place=place)


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """Return all `meshes`, which know the same of their corners, as one."""
    start = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes[:-1]])
    wind = [mesh.wind for mesh in meshes if mesh.wind is not None]
    openness = [mesh.openness for mesh in meshes if mesh.openness is not None]
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([mesh.faces + first for mesh, first in zip(meshes, start, strict=True)]).astype(np.int32),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate([mesh.uv for mesh in meshes]),
        np.concatenate(wind) if wind else None,
        np.concatenate(openness) if openness else None,
    )


def _frames(plant: Plant, index: Ints) -> tuple[Floats, Floats]:
    """Rows (n, 3, 3) are a card's x, y, z; the stretch (n, 3) along them in m."""
    axis, normal = plant.leaf_axis[index], plant.leaf_normal[index]
    length, width = plant.leaf_size[index, :1], plant.leaf_size[index, 1:]
    return np.stack([np.cross(axis, normal), axis, normal], axis=1), np.concatenate([width, length, width], axis=1)


def _has_holes(material: Material) -> bool:
    return material.base is not None and material.base.shape[2] == 4 and material.cutoff is not None


def _rhomb() -> Card:
    """A leaf of area pi/4 for materials that do not cut outlines."""
    place = np.array([[0, 0, 0], [math.pi / 4, 0.45, 0], [0, 1, 0], [-math.pi / 4, 0.45, 0]], dtype=np.float32)
    uv = np.column_stack([place[:, 0] / (math.pi / 2) + 0.5, place[:, 1]]).astype(np.float32)
    normal = np.tile(np.array([0, 0, 1], dtype=np.float32), (4, 1))
    return Card(place, normal, uv, np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32))


def _slip(card: Card, material: Material) -> Card:
    """The triangle of the card, with its point at the stalk or at the tip, that holds most of the leaf."""
    if _has_holes(material):
        up, down = _held(material)
        weights = _weights(((0, 0), (1, 1), (2, 3)) if up >= down else ((0, 1), (2, 2), (3, 3)))
    else:
        weights = _weights(((0, 0), (1, 1), (3, 3)))  # the lower part of the rhomb
    faces = np.array([[0, 1, 2]], dtype=np.int32)
    place, uv = (np.asarray(weights @ corners, dtype=np.float32) for corners in (card.place, card.uv))
    return Card(place, card.normal[:3], uv, faces)


def _weights(corners: Sequence[tuple[int, int]]) -> NDArray[np.float64]:
    """Rows (3, 4) that make points of the corners of a card: each the middle of two."""
    rows = np.zeros((3, 4))
    for row, (a, b) in zip(rows, corners, strict=True):
        row[a] += 0.5
        row[b] += 0.5
    return rows


def _held(material: Material) -> tuple[float, float]:
    """Shares of the leaf in the triangles with their points at the top and at the bottom of the texture."""
    assert material.base is not None
    assert material.cutoff is not None
    step = max(len(material.base) // _TEXELS, 1)
    there = material.base[step // 2 :: step, step // 2 :: step, 3] >= 255 * material.cutoff
    down = (np.arange(there.shape[0]) + 0.5) / there.shape[0]
    off = np.abs((np.arange(there.shape[1]) + 0.5) / there.shape[1] - 0.5)
    total = max(int(there.sum()), 1)
    return float((there & (off <= down[:, None] / 2)).sum() / total), float(
        (there & (off <= (1 - down[:, None]) / 2)).sum() / total
    )
