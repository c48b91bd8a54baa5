"""The materials of a tree: bark and leaves, coloured as the user, the picture or the project says."""

from __future__ import annotations

from dataclasses import dataclass

from treefit.asset.material.colour import Colour
from treefit.asset.material.material import Material
from treefit.asset.settings import AssetSettings

BARK: Colour = (112, 88, 68)
LEAF: Colour = (98, 140, 62)


@dataclass(frozen=True)
class TreeColours:
    """Colours of bark and leaves as a picture shows them; None where it does not."""

    bark: Colour | None = None
    leaf: Colour | None = None


def tree_materials(settings: AssetSettings, outline: str, seen: TreeColours | None = None) -> dict[str, Material]:
    """Return 'bark' and 'leaves' for leaves of `outline`; `seen` are the colours of the user's picture."""
    seen = seen if seen is not None and settings.colours == "from_image" else TreeColours()
    bark, leaf = settings.bark or seen.bark or BARK, settings.leaf or seen.leaf or LEAF
    return {
        "bark": Material("bark", bark),
        "leaves": Material("leaves", leaf, rough=0.75, two_sided=True),
    }
