"""Leaf textures: what one leaf of each outline looks like, in the square of its card."""

from __future__ import annotations

from functools import cache

from treefit.asset.material.leaf_blade import blade_drawing
from treefit.asset.material.leaf_feather import feather_drawing
from treefit.asset.material.leaf_sprig import sprig_drawing
from treefit.asset.material.texture import Textures, textures_of
from treefit.asset.mesh.blade import BLADES
from treefit.plant import LeafShape
from treefit.plant.look import SPRIGS


@cache
def leaf_textures(shape: LeafShape, size: int) -> Textures:
    """Return the textures (size, size) of a leaf of `shape`; its alpha is the outline."""
    draw = sprig_drawing if shape in SPRIGS.values() else blade_drawing if shape in BLADES else feather_drawing
    return textures_of(draw(shape, size))
