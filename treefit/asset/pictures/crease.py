"""Creases: what lies deeper than its surroundings is darker, which tells one clump of leaves from the next."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter

Floats = NDArray[np.float32]

_REACH = 0.035  # of the picture's height: side of the square that is the surroundings
_DEEP = 0.10  # of the plant's height: what lies so much deeper has lost _TAKEN of its light
_TAKEN = 0.55


def creases(depth: Floats, finer: int, tall: float) -> Floats:
    """Return the share of light (h, w) that is left, from `depth` (finer * h, finer * w) in m, infinite for none.

    Depth less its mean over the surroundings (Luft, Colditz and Deussen 2006, Image enhancement by unsharp masking
    the depth buffer).
    """
    h, w = depth.shape[0] // finer, depth.shape[1] // finer
    nearest = depth.reshape(h, finer, w, finer).min(axis=(1, 3))
    there = np.isfinite(nearest)
    filled = np.where(there, nearest, np.float32(0))
    size = max(round(_REACH * h), 3)
    weight = uniform_filter(there.astype(np.float32), size, mode="constant")
    mean = uniform_filter(filled, size, mode="constant") / np.maximum(weight, np.float32(1e-6))
    deeper = np.where(there, filled - mean, 0) / (_DEEP * tall)
    return np.asarray(1 - _TAKEN * np.clip(deeper, 0, 1), dtype=np.float32)
