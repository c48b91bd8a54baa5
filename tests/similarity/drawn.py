"""Drawn trees for the similarities: an ellipse of foliage with holes on a trunk, each of its traits a number."""

from __future__ import annotations

import numpy as np

from treefit.mask import BRANCH, FOLIAGE, Mask

SIDE = 256


def tree(width: float = 0.3, lift: float = 0.0, holes: float = 0.1, trunk: float = 0.02, lean: float = 0.0) -> Mask:
    """Mask (SIDE, SIDE) whose crown ends `lift` higher at its bottom; lengths in heights; `holes` is a share."""
    y, x = np.mgrid[:SIDE, :SIDE] / SIDE
    x, up = x - 0.5 + 0.5 / SIDE, 1.0 - y
    bottom = 0.3 + lift
    crown = (x / width) ** 2 + ((up - (1 + bottom) / 2) / ((1 - bottom) / 2)) ** 2 <= 1
    crown[:2, SIDE // 2] = True  # the top stays where it is
    order = np.random.default_rng(5).random((SIDE // 8, SIDE // 8))  # the same holes come first, whatever their share
    crown &= ~(np.kron(order, np.ones((8, 8))) < holes)
    stem = (np.abs(x - lean * up) <= trunk) & (up <= bottom + 0.05)
    mask = np.zeros((SIDE, SIDE), np.uint8)
    mask[stem] = BRANCH
    mask[crown] = FOLIAGE
    return mask
