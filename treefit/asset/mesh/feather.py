"""Feathers: leaves of slips along a midrib, one triangle each: palm fronds, tufts of needles, sprays of scales."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Feather:
    """Slips (n,) of a leaf of length 1 and width 1: each stands on one of the parts of the midrib."""

    midrib: Floats  # (m + 1,) from the stalk to the last slip
    part: NDArray[np.int64]  # (n,) part of the midrib
    turn: Floats  # (n,) rad around the midrib, 0 is across
    reach: Floats  # (n,) of the tip from the midrib, to be scaled
    tip: Floats  # (n,) place of the tip along the leaf

    def corners(self) -> tuple[Floats, Floats, Floats]:
        """Places (c, 3), unit normals (c, 3), flat places (c, 2) of the midrib, then of the tips; area pi/4."""
        area = (np.diff(self.midrib)[self.part] * self.reach).sum() / 2
        reach = self.reach * math.pi / 4 / area
        right = np.where(np.cos(self.turn) >= 0, 1.0, -1.0)
        x, z = np.cos(self.turn), np.sin(self.turn)
        rib, none = np.zeros_like(self.midrib), np.zeros_like(x)
        place = np.column_stack([np.r_[rib, reach * x], np.r_[self.midrib, self.tip], np.r_[rib, reach * z]])
        normal = np.column_stack([np.r_[rib, -right * z], np.r_[rib, none], np.r_[rib + 1, right * x]])
        return place, normal, np.column_stack([np.r_[rib, right * reach], place[:, 1]])

    def faces(self) -> NDArray[np.int64]:
        """Triangles (n, 3), each seen from the side of the leaf's normal."""
        low, high, tip = self.part, self.part + 1, len(self.midrib) + np.arange(len(self.part))
        seen = np.cos(self.turn) >= 0
        return np.column_stack([low, np.where(seen, tip, high), np.where(seen, high, tip)])


def frond(fold: float) -> Feather:
    """Return a feather leaf: 12 leaflets on either side, raised by `fold` rad, longest under the middle."""
    n = 12
    midrib = np.linspace(0, 0.94, n + 1)
    part = np.repeat(np.arange(n), 2)
    at = part / (n - 1)
    reach = np.sin(np.pi * (0.14 + 0.74 * at**0.8)) ** 0.8
    tip = midrib[part + 1] + (1 - midrib[part + 1]) * (0.25 + 0.75 * at**3)
    return Feather(midrib, part, np.tile([fold, np.pi - fold], n), reach, tip)


def tuft() -> Feather:
    """Return a twig of needles: three whorls of three, each turned against the one before it."""
    whorls, needles = 3, 3
    midrib = np.linspace(0, 0.7, whorls + 1)
    part = np.repeat(np.arange(whorls), needles)
    turn = np.tile(np.arange(needles) * 2 * np.pi / needles, whorls) + part * np.pi / needles + 0.25
    at = part / (whorls - 1)
    return Feather(midrib, part, turn, 1 - 0.45 * at**2, 0.45 + 0.55 * at)


def spray(fold: float) -> Feather:
    """Return a flat spray of scale leaves, as of a thuja or cypress: 7 twigs on either side that lean to the tip."""
    n = 7
    midrib = np.linspace(0, 0.9, n + 1)
    part = np.repeat(np.arange(n), 2)
    at = part / (n - 1)
    reach = np.sin(np.pi * (0.2 + 0.66 * at**0.9))
    tip = midrib[part + 1] + (1 - midrib[part + 1]) * (0.42 + 0.58 * at**2)
    return Feather(midrib, part, np.tile([fold, np.pi - fold], n), reach, tip)
