"""ImSim of the paper: stripes compared one by one (sec. 4).

Where the paper is silent: overlaps and weights of its authors' later settings, with one mend - a picture without any
trunk stripe can score 1. Identical stripes score exactly 1.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.similarity.stripes import Stripes, stripes
from treefit.view.frame import BitMask


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class PaperSimilarity:
    """Compares masks by `stripes` bands; `cross` is what dense crown over sparse crown counts.

    `wood_slack` is added to both shares of wood before they are compared: at 0.1 (its authors) a tenth of visible twigs
    halves a stripe, though masks of photographs call such twigs foliage.
    """

    stripes: int = Field(default=24, ge=4, le=64)
    cross: float = Field(default=0.9, ge=0, le=1)
    trunk_share: float = Field(default=0.67, gt=0.5, le=1)
    wood_slack: float = Field(default=1.0, gt=0, le=10)

    def describe(self, bits: BitMask) -> Stripes:
        """Stripes of a mask: what is kept of the target and taken of every candidate."""
        return stripes(bits, self.stripes)

    def compare(self, target: Stripes, plant: Stripes) -> float:
        """ImSim in [0, 1]; 1 for identical stripes, 0 when nothing overlaps."""
        return float(
            image_similarity(
                target.crown, target.dense, target.branch, target.foliage,
                plant.crown, plant.dense, plant.branch, plant.foliage,
                np.float32(self.cross), np.float32(self.trunk_share), np.float32(self.wood_slack),
            )
        )  # fmt: skip


@njit(inline="always")
def _overlap(a, b, c, d):
    """Length shared by the intervals [a, b] and [c, d]."""
    return max(min(b, d) - max(a, c), 0.0)


@njit(inline="always")
def _ratio(u, v):
    """Smaller by larger of two shares, 1 when both are 0."""
    return 1.0 if u == v else min(u, v) / max(u, v)


@njit(inline="always")
def _full(x):
    """The share x, 1 where rounding alone keeps it from being 1 (a pixel is at least a thousand times more)."""
    return 1.0 if x > 1.0 - 1e-6 else x


@njit(inline="always")
def _smoothstep(x):
    return x * x * (3.0 - 2.0 * x)


@njit(cache=True, nogil=True, error_model="numpy")
def image_similarity(
    crown1, dense1, branch1, foliage1, crown2, dense2, branch2, foliage2, cross, trunk_share, wood_slack
):
    """ImSim of the stripes 1 (picture) and 2 (plant)."""
    found = most = trunk_found = trunk_most = 0.0
    n_used = n_trunk = 0
    for s in range(len(branch1)):
        a1, d1, a2, d2 = crown1[s, 0], crown1[s, 1], crown2[s, 0], crown2[s, 1]
        if d1 - a1 <= 0 and d2 - a2 <= 0:
            continue
        n_used += 1
        widest = 0.5 * max(d1 - a1, d2 - a2)
        match = _match(a1, dense1[s, 0], dense1[s, 1], d1, a2, dense2[s, 0], dense2[s, 1], d2, cross)
        wood1 = branch1[s] / max(branch1[s] + foliage1[s], 1e-6)
        wood2 = branch2[s] / max(branch2[s] + foliage2[s], 1e-6)
        fill = wood1 * _ratio(branch1[s], branch2[s]) + (1.0 - wood1) * _ratio(foliage1[s], foliage2[s])
        gained = _smoothstep(_full(match / widest)) * widest
        gained *= _smoothstep(max(np.sqrt(min(fill, 1.0)), 0.01)) * _ratio(wood1 + wood_slack, wood2 + wood_slack)
        found += gained
        most += widest
        if wood1 > trunk_share:  # "according to the ratio B/L each stripe refers either to the crown or to the trunk"
            n_trunk += 1
            trunk_found += gained
            trunk_most += widest
    if n_used == 0 or most == 0:
        return 0.0
    if n_trunk == 0:
        return found / most
    weight = (n_trunk + 1.0) / (n_used + 1.0)
    return found / most + weight * (trunk_found / trunk_most - found / most)


@njit(inline="always")
def _match(a1, b1, c1, d1, a2, b2, c2, d2, cross):
    """Half of the shared length, dense over sparse crown at the weight `cross`."""
    low_low = _overlap(a1, b1, a2, b2) + _overlap(a1, b1, c2, d2) + _overlap(c1, d1, a2, b2) + _overlap(c1, d1, c2, d2)
    low_high = _overlap(a1, b1, b2, c2) + _overlap(c1, d1, b2, c2)
    high_low = _overlap(b1, c1, a2, b2) + _overlap(b1, c1, c2, d2)
    return 0.5 * (low_low + _overlap(b1, c1, b2, c2) + cross * (low_high + high_low))
