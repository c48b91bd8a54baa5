"""Texture: whether a crown is as open, as broken and as ragged as the target's, wherever its gaps are."""

from __future__ import annotations

from treefit.similarity.measures.rows import Rows

BANDS = 10
"""Bands of equal height that are compared each by itself."""

FILL, RUNS, ROUGHNESS = 0.35, 0.40, 0.25
"""Weights of the three terms of a band; they add up to 1."""

FULLEST = 1.05
"""Fill is compared as what is left to this, so that full bands can be alike and gaps are what counts."""

SMOOTHEST = 100 * 0.7 / 120
"""Added to a roughness, in % of the height: 0.7 pixels of a plant 120 pixels high, what pixels alone can make."""


def texture(target: Rows, plant: Rows) -> float:
    """Likeness of texture in [0, 1], the mean over BANDS bands weighted by the target's hull in each.

    A band counts 0.35 cmp(1.05 - fill) + 0.40 cmp(runs) + 0.25 cmp(roughness + 0.583 %), where cmp(x) is the smaller by
    the larger of the plant's and the target's x, or 0 when it holds nothing of the plant.
    """
    height = len(target.left)
    likeness, weight = 0.0, 0
    for i in range(BANDS):
        first, end = i * height // BANDS, (i + 1) * height // BANDS
        wanted, found = target.band(first, end), plant.band(first, end)
        hull = int(wanted.widths.sum())
        likeness += hull * _band(wanted, found)
        weight += hull
    return likeness / weight


def _band(target: Rows, plant: Rows) -> float:
    if not plant.runs.any() or not target.runs.any():
        return 0.0
    return (
        FILL * _compare(FULLEST - target.fill, FULLEST - plant.fill)
        + RUNS * _compare(target.mean_runs, plant.mean_runs)
        + ROUGHNESS * _compare(target.roughness + SMOOTHEST, plant.roughness + SMOOTHEST)
    )


def _compare(one: float, two: float) -> float:
    return min(one, two) / max(one, two)
