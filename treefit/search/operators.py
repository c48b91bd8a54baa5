"""Moves of the elementary genetic algorithm (sec. 5) and of other searches, each on one population of genomes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from treefit.search.optimizer import Genomes, Scores

TRIES = 5
"""Times that a child which equals another is changed, before it is scored again."""


def fittest(genomes: Genomes, scores: Scores, count: int) -> tuple[Genomes, Scores]:
    """Return the `count` best genomes and their scores, best first; ties keep their order."""
    order = np.argsort(-scores, kind="stable")[:count]
    return genomes[order], scores[order]


def pick_parents(
    scores: Scores, count: int, rng: np.random.Generator, power: float = 1.0, least: float = 0.0
) -> np.ndarray[tuple[int, ...], np.dtype[np.int64]]:
    """Pairs of indices (count, 2) of different parents, chosen in proportion to their fitness, score^power + least.

    All are alike where every fitness is 0.
    """
    fitness = np.maximum(scores, 0.0) ** power + least
    share = fitness / fitness.sum() if fitness.any() else np.full(len(scores), 1 / len(scores))
    first = rng.choice(len(scores), size=count, p=share)
    second = rng.choice(len(scores), size=count, p=share)
    second = np.where(second == first, (second + 1 + rng.integers(len(scores) - 1, size=count)) % len(scores), second)
    return np.stack([first, np.where(second == first, (first + 1) % len(scores), second)], axis=1)


def one_dot_crossover(first: Genomes, second: Genomes, rng: np.random.Generator) -> Genomes:
    """Children (m, n): the first parent's genes up to a random place, the second's from there on."""
    m, n = first.shape
    dot = rng.integers(1, max(n, 2), size=(m, 1))
    return np.where(np.arange(n) < dot, first, second)


def uniform_crossover(first: Genomes, second: Genomes, rng: np.random.Generator) -> Genomes:
    """Children (m, n): every gene from either parent."""
    return np.where(rng.random(first.shape) < 0.5, first, second)


def mirrored(places: Genomes) -> Genomes:
    """Any coordinates (m, n) as ones of [0, 1]: a path that leaves the interval is thrown back at its end."""
    return np.abs((places + 1) % 2 - 1)


def without_twins(children: Genomes, population: Genomes, change: Callable[[Genomes], Genomes]) -> Genomes:
    """Children (m, n) of which those that equal one of `population` (p, n) or an earlier child went through `change`.

    It is tried a few times, for a change may lead to another twin.
    """
    children = children.copy()
    for _ in range(TRIES):
        twins = _twins(children, population)
        if not twins:
            break
        children[twins] = change(children[twins])
    return children


def _twins(children: Genomes, population: Genomes) -> list[int]:
    seen, twins = {genome.tobytes() for genome in population}, []
    for i, genome in enumerate(children):
        if genome.tobytes() in seen:
            twins.append(i)
        seen.add(genome.tobytes())
    return twins
