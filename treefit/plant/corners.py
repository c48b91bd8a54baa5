"""Corners: how many corners the rings of each stem have in a mesh, and where a trunk is so lobed that it needs more."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.plant.chains import Chains
from treefit.plant.look import Look

A_LOBE = 4  # corners: crest, flank, hollow, flank
SHALLOWEST = 0.02  # depth of lobes as a share of the radius under which a stem is round
MOST = 24  # lobes; more would be bark
FEWEST_SIDES = 5  # of the thickest stem for which lobes are worth their corners


@dataclass(frozen=True, eq=False)
class LobedStems:
    """The stems (s,) that have `count` lobes, and the depth (r,) of these by ring, as a share of its radius."""

    count: int
    stem: NDArray[np.bool_]
    depth: NDArray[np.float64]


def corners_of(stems: Chains, lobed: LobedStems | None, sides: int) -> NDArray[np.int64]:
    """Corners of the rings of each stem (s,): `sides` at the thickest, less by the fifth root; four a lobe."""
    thickest = np.maximum.reduceat(stems.radius, stems.first[:-1])
    wanted = np.round(sides * (thickest / thickest.max()) ** 0.2)
    round_ones: NDArray[np.int64] = np.clip(wanted, fewest_corners(sides), sides).astype(np.int64)
    if lobed is None:
        return round_ones
    wavy = lobed.count * np.maximum(A_LOBE, -(-round_ones // lobed.count))
    return np.asarray(np.where(lobed.stem, wavy, round_ones), dtype=np.int64)


def fewest_corners(sides: int) -> int:
    """Corners of the rings of the thinnest stems."""
    return min(4, sides)


def lobed_stems(stems: Chains, look: Look | None, sides: int) -> LobedStems | None:
    """Return which stems of level 0 have lobes; None when there are none to be seen at `sides` corners."""
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
    return LobedStems(look.lobes, stem, np.where(np.repeat(stem, np.diff(stems.first)), depth, 0.0))
