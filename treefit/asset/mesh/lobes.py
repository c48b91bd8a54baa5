"""Lobes: a trunk whose section is not round (Weber and Penn 1995, sec. 4.4), as factors of the radius of its rings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.asset.mesh.stems import Stems, narrowing
from treefit.plant.corners import LobedStems

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Lobes:
    """The radius of ring i at an angle is radius[i] * (1 + depth[i] * sin(count * angle))."""

    count: int
    depth: Floats  # (r,) share of the radius, falls with the height to 0 at the top of the trunk
    stem: NDArray[np.bool_]  # (s,) the stems that have them
    loss: Floats  # (r,) loss of radius * depth per metre

    def swell(self, ring: NDArray[np.int64], angle: Floats) -> tuple[Floats, Floats, Floats]:
        """Factor of the radius at corners (c,); their normal's share against the turn and along the stem."""
        wave, slope = np.sin(self.count * angle), self.count * np.cos(self.count * angle)
        factor = 1 + self.depth[ring] * wave
        return factor, self.depth[ring] * slope / factor, self.loss[ring] * wave


def lobes_of(stems: Stems, found: LobedStems | None) -> Lobes | None:
    """Return the lobes of the stems that were `found` to have them, None when none was."""
    if found is None:
        return None
    loss = narrowing(stems.first, stems.along, stems.radius * found.depth)
    return Lobes(found.count, found.depth, found.stem, loss)
