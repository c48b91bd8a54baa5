"""The naive view against OpenGL: two ways to draw the same leaves and stems that share no line of code."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from experiments.zbuffer_view import Outline, zbuffer_mask
from treefit.asset.mesh.leaf_outline import leaf_card
from treefit.mask import BRANCH, FOLIAGE, Mask
from treefit.plant import Plant
from treefit.view import Frame
from treefit.view.gl import gl_mask

CLASSES = {"branch": BRANCH, "foliage": FOLIAGE}


def gl_agreement(plants: Sequence[Plant], frame: Frame) -> dict[str, float]:
    """Mean over plants of each class's intersection by union, and pixels of OpenGL by those of the naive view."""
    outline = card_outline()
    pairs = [(zbuffer_mask(plant, frame, outline), gl_mask(plant, frame.height, frame.half_width)) for plant in plants]
    found = {f"{name}_iou": _mean_overlap(pairs, label) for name, label in CLASSES.items()}
    counts = {name: [sum(int((mask == label).sum()) for mask in side) for side in zip(*pairs, strict=True)]
              for name, label in CLASSES.items()}  # fmt: skip
    return found | {f"{name}_pixels": gl / max(naive, 1) for name, (naive, gl) in counts.items()}


def card_outline() -> Outline:
    """The round leaf of the meshes that OpenGL draws, as an outline of the naive view."""
    across, along, _ = leaf_card("round").place.astype(np.float64).T
    corners = np.column_stack([2 * along - 1, 2 * across])
    outline: Outline = corners[np.argsort(np.arctan2(corners[:, 1], corners[:, 0]))]
    return outline


def _mean_overlap(pairs: Sequence[tuple[Mask, Mask]], label: int) -> float:
    both = [(one == label, two == label) for one, two in pairs if (one == label).any()]
    return float(np.mean([(one & two).sum() / (one | two).sum() for one, two in both]))
