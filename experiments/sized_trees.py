"""Trees of a wanted size: random genomes whose plants come nearest to it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from treefit.plant import Budget, Generator, Genome

DRAWS = 3_000
CLOSE, STEPS, CHILDREN, STEP = 0.3, 6, 60, 0.1
"""Sizes that random genomes do not come CLOSE to are reached in STEPS, each of that many changed copies of the best."""


def trees_of(
    generator: Generator, sizes: Sequence[tuple[int, int]], count: int, seed: int, draws: int = DRAWS
) -> list[list[Genome]]:
    """`count` genomes (n,) for each of the `sizes` (vertices, leaves): of all that are drawn the nearest ones."""
    rng = np.random.default_rng(seed)
    budget = Budget(2 * max(vertices for vertices, _ in sizes), 2 * max(leaves for _, leaves in sizes))
    drawn = list(rng.random((draws, len(generator.space))))
    found = [_size(generator, genome, seed, budget) for genome in drawn]
    chosen = []
    for wanted in sizes:
        pairs = _nearest([(_distance(size, wanted), genome) for size, genome in zip(found, drawn, strict=True)], count)
        for _ in range(STEPS):
            if pairs[-1][0] <= CLOSE:
                break
            steps = rng.normal(0, STEP, (CHILDREN, len(generator.space)))
            children = [np.clip(pairs[i % count][1] + step, 0, 1) for i, step in enumerate(steps)]
            born = [(_distance(_size(generator, child, seed, budget), wanted), child) for child in children]
            pairs = _nearest([*pairs, *born], count)
        chosen.append([genome for _, genome in pairs])
    return chosen


def _nearest(pairs: list[tuple[float, Genome]], count: int) -> list[tuple[float, Genome]]:
    return sorted(pairs, key=lambda pair: pair[0])[:count]


def _size(generator: Generator, genome: Genome, seed: int, budget: Budget) -> tuple[int, int] | None:
    """Vertices and leaves of the plant of `genome`; None when it was cut."""
    plant = generator(generator.space.decode(genome), seed, budget)
    return None if plant.cut else (plant.n_vertices, plant.n_leaves)


def _distance(size: tuple[int, int] | None, wanted: tuple[int, int]) -> float:
    """How far a size is from the wanted one, in factors of e of vertices and leaves together."""
    if size is None:
        return math.inf
    return sum(abs(math.log((a + 1) / (b + 1))) for a, b in zip(size, wanted, strict=True))
