"""The materials of a tree: bark and leaves, coloured as the user, the picture or the project says."""

from __future__ import annotations

import colorsys
from collections.abc import Mapping
from dataclasses import dataclass, replace

from treefit.asset.material.bark import bark_textures
from treefit.asset.material.colour import Colour
from treefit.asset.material.leaf import leaf_textures
from treefit.asset.material.material import Material
from treefit.asset.material.texture import CUTOFF, Textures
from treefit.asset.settings import AssetSettings
from treefit.plant import LeafShape

BARK: Colour = (112, 88, 68)
LEAF: Colour = (98, 140, 62)
_LEAVES: Mapping[str, Colour] = {
    "needle": (76, 104, 62), "tuft": (76, 104, 62), "scale": (92, 114, 56), "narrow": (116, 142, 84),
}  # fmt: skip
"""Colours of leaves that are not LEAF, by their outline."""


@dataclass(frozen=True)
class TreeColours:
    """Colours of bark and leaves as a picture shows them; None where it does not."""

    bark: Colour | None = None
    leaf: Colour | None = None


def tree_materials(settings: AssetSettings, outline: LeafShape, seen: TreeColours | None = None) -> dict[str, Material]:
    """Return 'bark' and 'leaves' for leaves of `outline`; `seen` are the colours of the user's picture.

    With textures the colours are those of their means, to be multiplied by them.
    """
    seen = seen if seen is not None and settings.colours == "from_image" else TreeColours()
    bark, leaf = settings.bark or seen.bark or BARK, settings.leaf or seen.leaf or _LEAVES.get(outline, LEAF)
    size = settings.texture_size
    if not size:
        return {"bark": Material("bark", bark), "leaves": Material("leaves", leaf, rough=0.75, two_sided=True)}
    kind = bark_kind(bark) if settings.bark_kind == "auto" else settings.bark_kind
    leaves = _textured("leaves", leaf, leaf_textures(outline, size))
    return {
        "bark": _textured("bark", bark, bark_textures(kind, size)),
        "leaves": replace(leaves, cutoff=CUTOFF, two_sided=True),
    }


def bark_kind(bark: Colour) -> str:
    """Return the kind of bark that goes with its colour: furrowed, plated, smooth or ringed."""
    hue, light, saturation = colorsys.rgb_to_hls(*(channel / 255 for channel in bark))
    if light > 0.66:
        return "ringed"
    if saturation > 0.3 and hue < 0.09:
        return "plated"
    return "smooth" if light > 0.45 and saturation < 0.14 else "furrowed"


def _textured(name: str, wished: Colour, textures: Textures) -> Material:
    colour, base = textures.coloured(wished)
    return Material(name, colour, base, textures.normal, textures.roughness, rough=1.0)
