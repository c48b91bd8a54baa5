"""Triangles: how many triangles the mesh of a plant has, counted without making it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from treefit.plant.chains import chains_of
from treefit.plant.corners import corners_of, fewest_corners, lobed_stems
from treefit.plant.curves import curves_of
from treefit.plant.generator import Budget
from treefit.plant.leaf_shape import leaf_shape_of
from treefit.plant.look import LEAF_SHAPES, SPRIGS
from treefit.plant.plant import Plant

SIDES, OUTLINE = 7, "auto"
"""Corners of the thickest stem and outline of the leaves of a mesh, as files have them by default."""

OF_A_LEAF: Mapping[str, int] = {
    "broad": 4, "round": 6, "narrow": 4, "lobed": 8, "needle": 2, "tuft": 9, "frond": 24,
    "oak": 10, "compound": 19, "scale": 14, **dict.fromkeys(SPRIGS.values(), 4),
}  # fmt: skip
"""Triangles of one leaf by its outline."""


def triangles(plant: Plant, sides: int = SIDES, outline: str = OUTLINE) -> float:
    """Count of triangles of the mesh at `sides` corners of the thickest stem, leaves of `outline` included.

    Stems are curves with collars, as the mesh has them. One of r rings with k corners has 2 k (r - 1) in its wall,
    k at its tip and k - 2 at its foot, k when lobed.
    """
    leaves = plant.n_leaves * OF_A_LEAF[leaf_shape_of(outline, plant)]
    chains = chains_of(plant)
    if not len(chains):
        return float(leaves)
    curves = curves_of(chains)
    lobed = lobed_stems(curves, plant.look, sides)
    corners = corners_of(chains, lobed, sides)
    wood = (2 * corners * np.diff(curves.first) - 2).sum()
    return float(leaves + wood + (0 if lobed is None else 2 * lobed.stem.sum()))


def budget_of(most: float, sides: int, outline: str) -> Budget:
    """Budget that every plant of at most `most` triangles is within.

    A stem of v vertices has v rings or more, so at least 2 k v - 2 triangles, which is (2 k - 1) v or more.
    """
    a_vertex = 2 * fewest_corners(sides) - 1
    a_leaf = min(OF_A_LEAF.values()) if outline == "auto" else OF_A_LEAF[outline]
    return Budget(max(int(most / a_vertex), 100), max(int(most / a_leaf), 200))


def check_outline(outline: str) -> str:
    """Return `outline`; ValueError when no leaf has it."""
    if outline not in ("auto", *LEAF_SHAPES):
        raise ValueError(f"must be one of auto, {', '.join(LEAF_SHAPES)}, got {outline!r}")
    return outline
