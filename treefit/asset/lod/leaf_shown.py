"""Leaf shown: how much of the view a leaf covers in the mean over all directions, whatever it is made of."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from treefit.asset.lod.silhouette import cover
from treefit.asset.mesh.leaf_outline import Card

Floats = NDArray[np.float32]
_DIRECTIONS = 24
_PIXELS = 96  # along the side of the square that a leaf of length 1 is seen in


def shown(card: Card, width: float, alpha: NDArray[np.uint8], cutoff: float) -> float:
    """Return the mean area that a leaf of length 1 and `width` covers, seen from directions all around it."""
    place = card.place * np.array([width, 1, width], dtype=np.float32) - np.array([0, 0.5, 0], dtype=np.float32)
    reach = 1.02 * max(float(np.linalg.norm(place, axis=1).max()), 0.5)
    count = 0
    for turn in _turns():
        screen = ((place @ turn.T) / reach + 1) * np.float32(_PIXELS / 2)
        out = np.zeros((_PIXELS, _PIXELS), dtype=np.bool_)
        cover(screen.astype(np.float32), card.faces, card.uv, alpha, np.float32(cutoff), out)
        count += int(out.sum())
    return count / _DIRECTIONS * (2 * reach / _PIXELS) ** 2


def _turns() -> list[Floats]:
    """Rows right, down, away of cameras spread evenly over a sphere."""
    turns = []
    for i in range(_DIRECTIONS):
        height, around = 1 - (2 * i + 1) / _DIRECTIONS, i * math.pi * (3 - math.sqrt(5))
        flat = math.sqrt(1 - height**2)
        away = np.array([flat * math.cos(around), flat * math.sin(around), height])
        right = np.cross(away, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        turns.append(np.stack([right, np.cross(away, right), away]).astype(np.float32))
    return turns
