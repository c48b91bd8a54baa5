"""Impostor: a tree as crossed cards with its own picture from each side, the last level of detail."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from treefit.asset.lod.bake import FINER, Baked, bake, cut_out
from treefit.asset.lod.view import Extent, View, side_view
from treefit.asset.material.colour import srgb_codes
from treefit.asset.material.material import Material
from treefit.asset.mesh import Mesh
from treefit.asset.model import Model, Part
from treefit.asset.pictures.scene import scene_of

Floats = NDArray[np.float32]
CUTOFF = 0.5
_PLAIN_SIZE = 256  # texels of the atlas where materials have no textures
_GAP = 2  # texels around each card


@dataclass(frozen=True, eq=False)
class _Card:
    """A rectangle in space and the cell of the atlas that it shows."""

    right: Floats  # (3,) unit
    up: Floats  # (3,) unit
    middle: Floats  # (3,) m
    half: tuple[float, float]  # width, height in m
    view: View


def impostor(model: Model, sides: int, texture_size: int) -> Model:
    """Return `model` as upright cards, `sides` of them, that cross at the trunk at equal angles, of one material.

    Each card shows the model as it is seen from its side: colours without sun, alpha, normals, all in one square
    atlas of `texture_size` texels a side; where materials have no textures (0) it has 256 all the same.
    """
    size = texture_size or _PLAIN_SIZE
    places = [part.mesh.vertices for part in model.parts.values()]
    cards = _cards(Extent.of(places), sides)
    rows, columns = _grid(cards, size)
    cell = (size // rows, size // columns)
    scene = scene_of(model, 0.0)
    base = np.zeros((size, size, 4), dtype=np.uint8)
    normal = np.full((size, size, 3), (128, 128, 255), dtype=np.uint8)
    corners: list[NDArray[np.float64]] = []
    for i, card in enumerate(cards):
        top, left = (i // columns) * cell[0], (i % columns) * cell[1]
        at, view = _fitted(card, cell)
        baked = bake(scene, view)
        base[top : top + cell[0], left : left + cell[1]] = _base(baked)
        normal[top : top + cell[0], left : left + cell[1]] = np.rint(baked.normal * 127.5 + 127.5)
        corners.append((np.array(at) + np.array([left, top, left, top])) / size)
    material = Material("impostor", (255, 255, 255), base, normal, rough=0.95, cutoff=CUTOFF, two_sided=True)
    return Model(model.name, {"impostor": Part(_mesh(cards, corners, model), material)})


def _cards(extent: Extent, sides: int) -> list[_Card]:
    up, middle = np.array([0, 0, 1], dtype=np.float32), np.array([0, 0, (extent.low + extent.high) / 2], np.float32)
    cards = []
    for i in range(sides):
        view = side_view(extent, 180 * i / sides, 256)
        right = view.turn[0] / np.float32(view.scale)
        cards.append(_Card(right, up, middle, (extent.reach, extent.height / 2), view))
    return cards


def _grid(cards: list[_Card], size: int) -> tuple[int, int]:
    """Rows and columns of the atlas with which upright cards are largest."""

    def scale(grid: tuple[int, int]) -> float:
        wide, high = cards[0].half
        return min(size / grid[0] / high, size / grid[1] / wide)

    count = len(cards)
    return max(((math.ceil(count / columns), columns) for columns in range(1, count + 1)), key=scale)


def _fitted(card: _Card, cell: tuple[int, int]) -> tuple[tuple[float, float, float, float], View]:
    """Left, top, right, bottom of the card in texels of its cell, and the view that fills the cell."""
    rows, columns = cell
    wide, high = card.half
    scale = min((columns - 2 * _GAP) / (2 * wide), (rows - 2 * _GAP) / (2 * high))
    left, top = columns / 2 - scale * wide, rows / 2 - scale * high
    axes = card.view.turn / np.float32(card.view.scale)
    turn = axes * np.float32(scale * FINER)
    shift = np.array([columns / 2, rows / 2, 0], dtype=np.float32) * FINER - turn @ card.middle
    view = View(turn, shift.astype(np.float32), scale * FINER, rows * FINER, columns * FINER)
    return (left, top, columns - left, rows - top), view


def _base(baked: Baked) -> NDArray[np.uint8]:
    alpha = np.rint(cut_out(baked.share, CUTOFF + 0.02) * 255).astype(np.uint8)
    return np.dstack([srgb_codes(baked.colour), alpha])


def _mesh(cards: list[_Card], corners: list[NDArray[np.float64]], whole: Model) -> Mesh:
    """Two triangles a card."""
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=np.float32)
    place, normal, uv = [], [], []
    for card, (left, top, right, bottom) in zip(cards, corners, strict=True):
        place.append(card.middle + signs[:, :1] * card.half[0] * card.right + signs[:, 1:] * card.half[1] * card.up)
        normal.append(np.tile(np.cross(card.right, card.up), (4, 1)))
        uv.append([[left, 1 - bottom], [right, 1 - bottom], [right, 1 - top], [left, 1 - top]])
    faces = np.concatenate([np.array([[0, 1, 2], [0, 2, 3]]) + 4 * i for i in range(len(cards))])
    mesh = Mesh(
        np.concatenate(place).astype(np.float32), faces.astype(np.int32), np.concatenate(normal).astype(np.float32),
        np.concatenate(uv).astype(np.float32),
    )  # fmt: skip
    return replace(mesh, wind=_wind(mesh, whole))


def _wind(mesh: Mesh, whole: Model) -> Floats | None:
    """The sway of the whole model's top at the top of the cards, none at their foot."""
    parts = [part.mesh for part in whole.parts.values()]
    known = [(part.vertices[:, 2], part.wind[:, 0]) for part in parts if part.wind is not None]
    if not known:
        return None
    height, bend = (np.concatenate(values) for values in zip(*known, strict=True))
    high = height >= np.quantile(height, 0.9)
    wind = np.zeros((len(mesh.vertices), 3), dtype=np.float32)
    share = np.clip(mesh.vertices[:, 2] / max(float(height.max()), 1e-6), 0, 1)
    wind[:, 0] = share * bend[high].mean()
    return wind
