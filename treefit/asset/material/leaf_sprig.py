"""Sprigs: textures of twigs of several leaves, each a blade's own drawing laid on the twig."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, map_coordinates

from treefit.asset.material.leaf_blade import blade_drawing, places
from treefit.asset.material.leaf_form import coverage, texels
from treefit.asset.material.noise import Field
from treefit.asset.material.texture import Drawing
from treefit.asset.mesh.leaf_frame import LeafFrame
from treefit.asset.mesh.leaf_outline import leaf_frame
from treefit.plant import LeafShape
from treefit.plant.look import SPRIGS

Floats = NDArray[np.float64]
Box = tuple[slice, slice]

_WIDTH = 0.55  # of a sprig by its length for which its leaves have their own proportions
_TWIG = np.array([0.62, 0.34, 0.26], np.float32)  # hue of the wood over that of leaves
_LOW, _ROUGH = 0.004, 0.8  # height, in sides of the texture, and roughness of the twig
_SHADOW, _SOFT = 0.6, 1 / 60  # of a leaf on those under it; how soft, in sides of the texture
_LEAN = 0.25  # slope of a leaf to the sprig, at most
_STEP = 0.0007  # that each leaf lies higher than the one before it
_SLIM = 0.3  # share of the width that leaves lack to their tips
_YELLOW = np.array([0.06, 0.015, -0.04])
_KINDS = {"broad": (0.323, 0.61), "oak": (0.31, 0.70), "lobed": (0.30, 1.0), "round": (0.295, 0.88)}
"""Length of the largest leaf of a sprig, by that of the sprig, and width of leaves by their length."""


@dataclass(frozen=True, eq=False)
class Placed:
    """Leaves (m,) in the order in which they are drawn; lengths in those of the sprig, x by _WIDTH."""

    base: Floats  # (m, 2)
    turn: Floats  # (m,) rad from the way of the twig to the right
    length: Floats  # (m,)
    width: Floats  # (m,)
    shade: Floats  # (m,)
    yellow: Floats  # (m,)
    lean: Floats  # (m, 2) slope across and along
    bend: Floats  # (m,) of the tip to a side, in widths


def sprig_drawing(shape: LeafShape, n: int) -> Drawing:
    """Sprig of `shape` in the square of its frame, n by n texels."""
    kind = next(kind for kind, sprig in SPRIGS.items() if sprig == shape)
    frame, own, leaf = leaf_frame(shape), leaf_frame(kind), blade_drawing(kind, max(n // 2, 1))
    wood = coverage([_twig()], frame, n)
    seen = Drawing(np.tile(_TWIG, (n, n, 1)), np.full_like(wood, _LOW), np.full_like(wood, _ROUGH), wood)
    placed = _placed(*_KINDS[kind])
    for one in range(len(placed.turn)):
        _lay(seen, *_moved(leaf, own, frame, placed, one, n))
    return seen


def _line(at: Floats) -> Floats:
    """Places (m, 2) of the twig."""
    return np.column_stack([0.014 * np.sin(2.2 * np.pi * at), at])


def _placed(length: float, width: float) -> Placed:
    """Leaves on both sides of the twig, smaller and steeper to its tip, then those over it, last the one at its tip."""
    rng = np.random.default_rng(75)
    at = np.r_[0.12, 0.18, 0.25, 0.32, 0.40, 0.47, 0.55, 0.62, 0.68, 0.2, 0.38, 0.53, 1 - 0.9 * length]
    turn = np.r_[1.1, -1.12, 1.1, -1.08, 1.06, -1.0, 0.9, -0.78, 0.6, 0.42, -0.4, 0.2, 0.05]
    large = np.r_[0.90, 0.98, 0.96, 1.02, 0.93, 0.99, 1.0, 0.94, 0.9, 0.8, 0.84, 0.8, 0.9]
    count = len(at)
    long = length * large
    long[:-1] *= rng.uniform(0.94, 1.04, count - 1)
    wide = width * long * rng.uniform(0.82, 1.0, count)
    shade = np.linspace(0.76, 1.06, count) * rng.uniform(0.84, 1.16, count)
    turn[:-1] += rng.normal(0, 0.07, count - 1)
    lean = rng.uniform(-_LEAN, _LEAN, (count, 2))
    bend = 0.2 * np.sin(turn) + rng.normal(0, 0.12, count)
    return Placed(_line(at), turn, long, wide, shade, rng.normal(0, 1, count), lean, bend)


def _twig() -> Floats:
    """Outline (m, 2) of the twig in the places of the sprig."""
    at = np.linspace(0, 0.72, 25)
    line, half = _line(at), 0.012 - 0.009 * at
    right, left = line + half[:, None] * [1, 0], line - half[:, None] * [1, 0]
    return np.concatenate([right, left[::-1]]) / [_WIDTH, 1]


def _moved(leaf: Drawing, own: LeafFrame, frame: LeafFrame, placed: Placed, one: int, n: int) -> tuple[Box, Drawing]:
    """Rows and columns of the texture of the sprig, and the `leaf` as its leaf `one` in them."""
    box = _box(frame, placed, one, n)
    x, y = (values[box] for values in places(frame, n))
    across, along = _on_leaf(x * np.float32(_WIDTH), y, placed, one)
    u, v = own.uv(*np.stack([across, along]).reshape(2, -1).astype(np.float64)).T
    texel = np.stack([1 - v, u]).reshape(2, *x.shape) * len(leaf.height) - 0.5

    def laid(values: Field) -> Field:
        return np.asarray(map_coordinates(values, texel, order=1, mode="constant"))

    assert leaf.alpha is not None
    hue = placed.shade[one] * (1 + placed.yellow[one] * _YELLOW)
    tone = np.stack([laid(leaf.tone[..., channel]) * hue[channel] for channel in range(3)], axis=-1)
    lean = placed.lean[one, 0] * (x - x.mean()) + placed.lean[one, 1] * (y - y.mean())
    height = laid(leaf.height) * placed.length[one] + lean + _STEP * one
    return box, Drawing(tone, height, laid(leaf.roughness), laid(leaf.alpha))


def _lay(seen: Drawing, box: Box, leaf: Drawing) -> None:
    """Draw `leaf` over what is `seen` in `box`, which it darkens around it."""
    assert leaf.alpha is not None
    assert seen.alpha is not None
    seen.tone[box] *= 1 - _SHADOW * gaussian_filter(leaf.alpha, _SOFT * len(seen.height))[..., None]
    seen.tone[box] += leaf.alpha[..., None] * (leaf.tone - seen.tone[box])
    seen.height[box] += leaf.alpha * (leaf.height - seen.height[box])
    seen.roughness[box] += leaf.alpha * (leaf.roughness - seen.roughness[box])
    seen.alpha[box] += leaf.alpha * (1 - seen.alpha[box])


def _on_leaf(x: Field, y: Field, placed: Placed, one: int) -> tuple[Field, Field]:
    """Places across and along leaf `one`, which is bent and drawn out to its tip, of places of the sprig."""
    sine, cosine = np.sin(placed.turn[one]), np.cos(placed.turn[one])
    x, y = x - placed.base[one, 0], y - placed.base[one, 1]
    along = (x * sine + y * cosine) / placed.length[one]
    across = (x * cosine - y * sine) / placed.width[one]
    far = np.clip(along, 0, 1) ** 2
    return (across - placed.bend[one] * far) / (1 - _SLIM * far), along


def _box(frame: LeafFrame, placed: Placed, one: int, n: int) -> Box:
    """Rows and columns of the texture that leaf `one` and its shadow can be in."""
    turn, long = placed.turn[one], placed.length[one]
    middle = placed.base[one] + long / 2 * np.array([np.sin(turn), np.cos(turn)])
    reach = 0.62 * max(long, 1.1 * placed.width[one]) + 3 * _SOFT
    column, row = texels((middle + reach * np.array([[-1, 1], [1, -1]])) / [_WIDTH, 1], frame, n).T
    left, top, right, bottom = np.clip([column[0], row[0], column[1] + 2, row[1] + 2], 0, n).astype(int)
    return slice(top, bottom), slice(left, right)
