"""Leaf shape: the outline that the leaves of a plant get, by its look and how large they are."""

from __future__ import annotations

from typing import cast

import numpy as np

from treefit.plant.look import SPRIGS, LeafShape
from treefit.plant.plant import Plant

SLENDER = 0.25
"""Width by length of leaves under which they are taken for needles."""

LARGE, LARGE_SHARE = 0.2, 1 / 40
"""Leaves longer than both, in m and by the plant's height, are taken for sprigs.

Hardly a tree has leaves over the first; under the second they look like leaves, however long.
"""


def leaf_shape_of(wanted: str, plant: Plant) -> str:
    """Return the leaf shape that is `wanted`; "auto" is that of the plant's look, without one by its leaves.

    Slender leaves stand for twigs of needles, all others are broad; those too large for a leaf stand for sprigs.
    """
    if wanted != "auto":
        return wanted
    shape = plant.look.leaf_shape if plant.look is not None else None
    if shape is None:
        shape = "tuft" if _is_slender(plant) else "broad"
    return SPRIGS[cast(LeafShape, shape)] if shape in SPRIGS and _is_large(plant) else shape


def _is_slender(plant: Plant) -> bool:
    length, width = plant.leaf_size.sum(axis=0)
    return bool(width < SLENDER * length)


def _is_large(plant: Plant) -> bool:
    """Whether more than half of the leaves are."""
    limit = max(LARGE, LARGE_SHARE * float(plant.position[:, 2].max(initial=0)))
    return bool(2 * np.count_nonzero(plant.leaf_size[:, 0] > limit) > plant.n_leaves)
