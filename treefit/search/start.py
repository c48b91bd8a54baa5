"""The first genomes of a search: uniform ones, and known ones with children of theirs."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from treefit.search.hints import Hints
from treefit.search.operators import mirrored, one_dot_crossover
from treefit.search.optimizer import Genomes

Start = Literal["random", "presets", "mixed", "guess"]
"""Uniform genomes; the known ones and children of theirs; the known ones, half children and half uniform genomes; the
known ones, then those that the target suggests (without a suggestion as mixed)."""

STEPS = (0.02, 0.05, 0.1)
"""Standard deviations of the genes of a child, every step as often: some children are near by, others far off."""


def leading(start: Start, hints: Hints) -> Genomes:
    """Genomes (m, n) that lead a search from the beginning."""
    return np.concatenate([hints.known, hints.guess]) if start == "guess" else hints.known


def first_genomes(
    start: Start, known: Genomes, places: NDArray[np.int64], rng: np.random.Generator, uniform: Genomes | None = None
) -> Genomes:
    """Genomes (m, n) at `places` (m,) of a first population, which the genomes `known` (k, n) lead, unless `random`.

    `uniform` (m, n) are taken in place of uniform ones. Without known ones every start is `random`, byte by byte.
    """
    genomes = rng.random((len(places), known.shape[1])) if uniform is None else uniform.copy()
    if start == "random" or not len(known):
        return genomes
    fresh = np.flatnonzero(places >= len(known))
    bred = fresh if start == "presets" else fresh[::2]
    genomes[bred] = children(known, len(bred), rng)
    genomes[places < len(known)] = known[places[places < len(known)]]
    return genomes


def promising(hints: Hints, count: int, tries: int, rng: np.random.Generator) -> Genomes:
    """Genomes (count, n), each that with the highest quality Q of `tries` uniform ones (sec. 5)."""
    drawn = rng.random((count * tries, len(hints)))
    best = hints.mark(drawn).reshape(count, tries).argmax(axis=1) if tries > 1 else np.zeros(count, np.intp)
    chosen: Genomes = drawn[best + tries * np.arange(count)]
    return chosen


def children(known: Genomes, count: int, rng: np.random.Generator) -> Genomes:
    """Children (count, n) of `known` (k, n): every gene moves by a normal step; half are crossed from two before."""
    first, second = known[rng.integers(len(known), size=(2, count))]
    crossed = np.where(rng.random((count, 1)) < 0.5, one_dot_crossover(first, second, rng), first)
    steps = rng.choice(STEPS, size=(count, 1))
    return mirrored(crossed + steps * rng.standard_normal(crossed.shape))
