"""Features: a mask as a few numbers that tell much of the genome, in units of plant height."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from treefit.similarity.stripes import stripes
from treefit.view.frame import BitMask

STRIPES = 24
WIDEST = 3.0
"""Farthest border in plant heights that is told apart: beyond it a plant is wide."""


def features(bits: BitMask) -> NDArray[np.float32]:
    """Features (f,) of a mask: borders of the crown and of what is dense, shares of branch and foliage, by stripes."""
    found = stripes(bits, STRIPES)
    borders = np.concatenate([found.crown.ravel(), found.dense.ravel()])
    return np.concatenate([np.clip(borders, -WIDEST, WIDEST), found.branch, found.foliage])
