"""Skin: what is known of every ring of the stems besides its place: uv of the bark, wind, shade of joints."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.asset.mesh.bark_uv import bark_uv
from treefit.asset.mesh.stems import Stems
from treefit.asset.mesh.wind import sway

_IN_FORK, _IN_GROUND = 0.6, 0.5  # openness where wood meets wood, and under the ground
_FADE = 1.5  # height in radii of the trunk at which a third of the ground's shade is left

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Skin:
    """Numbers by stem (s,) and by ring (r,)."""

    around: Floats  # (s,) pictures of the bark around the stem
    v: Floats  # (r,) place along the picture
    bend: Floats  # (r,) in [0, 1]
    phase: Floats  # (r,) in [0, 1]
    shade: Floats  # (r,) in [0, 1], openness as the nearest wood and the ground leave it

    def wind(self, ring: NDArray[np.int64]) -> NDArray[np.float32]:
        """Wind (c, 3) at corners of rings (c,); wood does not flutter."""
        return np.column_stack([self.bend[ring], self.phase[ring], np.zeros(len(ring))]).astype(np.float32)


def skin_of(stems: Stems) -> Skin:
    """Return the skin of `stems`."""
    return Skin(*bark_uv(stems), *sway(stems), _shade(stems))


def _shade(stems: Stems) -> Floats:
    """Shade of forks, and of the ground around the trunk where it grows out of it."""
    shade = np.where(stems.collar < 0, 1.0, _IN_FORK + (1 - _IN_FORK) * np.maximum(stems.collar, 0.0))
    if stems.grown:
        height = np.maximum(stems.centre[:, 2] - stems.centre[stems.first[0] + 1, 2], 0.0)
        near = np.exp(-height / (_FADE * stems.radius[stems.first[0]])) * (stems.level[stems.stem] == 0)
        shade = shade * (1 - (1 - _IN_GROUND) * near)
    return shade
