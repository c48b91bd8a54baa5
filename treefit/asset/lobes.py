"""Lobes: a trunk whose section is not round (Weber and Penn 1995, sec. 4.4), as factors of the radius of its rings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.asset.stems import Stems, narrowing
from treefit.plant import Look

CORNERS = 4  # a lobe: crest, flank, hollow, flank
SHALLOWEST = 0.02  # depth as a share of the radius under which a stem is round
MOST = 24  # lobes; more would be bark
FEWEST_SIDES = 5  # of the thickest stem for which lobes are worth their corners

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Lobes:
    """The radius of ring i at an angle is radius[i] * (1 + depth[i] * sin(count * angle))."""

    count: int
    depth: Floats  # (r,) share of the radius, falls with the height to 0 at the top of the trunk
    stem: NDArray[np.bool_]  # (s,) the stems that have them
    loss: Floats  # (r,) loss of radius * depth per metre

    def corners(self, sides: NDArray[np.int64]) -> NDArray[np.int64]:
        """Corners (s,) of the rings: whole numbers a lobe where there are lobes, else `sides` (s,)."""
        lobed = self.count * np.maximum(CORNERS, -(-sides // self.count))
        return np.where(self.stem, lobed, sides)

    def swell(self, ring: NDArray[np.int64], angle: Floats) -> tuple[Floats, Floats, Floats]:
        """Factor of the radius at corners (c,); their normal's share against the turn and along the stem."""
        wave, slope = np.sin(self.count * angle), self.count * np.cos(self.count * angle)
        factor = 1 + self.depth[ring] * wave
        return factor, self.depth[ring] * slope / factor, self.loss[ring] * wave


def lobes_of(look: Look | None, stems: Stems, sides: int) -> Lobes | None:
    """Return the lobes of the stems of level 0, None when there are none to be seen at `sides` corners."""
    if look is None or not 0 < look.lobes <= MOST or look.lobe_depth <= SHALLOWEST or sides < FEWEST_SIDES:
        return None
    trunk = stems.level == 0
    ring = np.repeat(trunk, np.diff(stems.first))
    if not ring.any():
        return None
    height = stems.centre[:, 2]
    low, high = height[ring].min(), height[ring].max()
    depth = look.lobe_depth * (1 - np.clip((height - low) / max(high - low, 1e-12), 0, 1))
    stem = trunk & (depth[stems.first[:-1]] > SHALLOWEST)
    depth = np.where(np.repeat(stem, np.diff(stems.first)), depth, 0.0)
    return Lobes(look.lobes, depth, stem, narrowing(stems.first, stems.along, stems.radius * depth))
