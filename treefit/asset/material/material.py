"""Material: what a surface looks like, as glTF 2.0 describes it; knows nothing of plants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.asset.material.colour import Colour

Texels = NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class Material:
    """A colour and, over it, textures whose row 0 is on top (v = 1); a texture repeats once a unit of uv."""

    name: str  # bark, leaves or impostor
    colour: Colour  # sRGB; multiplies the base texture
    base: Texels | None = None  # (h, w, 3) or, where parts are not there, (h, w, 4) sRGB
    normal: Texels | None = None  # (h, w, 3) in tangent space, green is up
    roughness: Texels | None = None  # (h, w), 255 is dull; multiplies `rough`
    rough: float = 0.95
    cutoff: float | None = None  # alpha under which there is nothing; None: no holes
    two_sided: bool = False
