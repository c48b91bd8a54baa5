"""Guided mutation (sec. 5): genes that matter change more often, and of several tries the most promising one stays.

The rate V(k) of a gene says how often it changes, the quality Q(G') which try is kept. A try differs from its genome in
a few genes only, so what it gains in Q is the sum of what these genes gain; whole genomes are never made.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.search.optimizer import Genomes

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

DRAWS = 2**16
"""Values of a draw of 16 bits: a table of that size turns it into a gene, faster than a search in summed weights."""
REDRAWS = 3
"""Times that genes drawn twice are drawn again, before the dearer draw among those left, with the same chances."""


@dataclass(frozen=True, eq=False)
class Guide:
    """What leads mutation, see `guide`."""

    weights: Floats  # (n,) of the genes
    table: NDArray[np.uint16]  # genes (DRAWS,), each as often as its weight wants
    marks: NDArray[np.float32]  # Q(i, j) of gene i in the j-th of k parts of [0, 1] (n, k)
    tries: int


def guide(rate: Floats, quality: Floats, floor: float, tries: int) -> Guide:
    """Guide by the rates V (n,), which count as `floor` at least, and the marks Q (n, k).

    All genes are alike where every rate is 0. Marks that are all alike cannot tell tries apart: then one is enough.
    """
    weights = np.maximum(rate, floor)
    weights = weights / weights.sum() if weights.any() else np.full(len(rate), 1 / len(rate))
    draws = (np.arange(DRAWS) + 0.5) / DRAWS
    table = np.minimum(np.searchsorted(weights.cumsum(), draws), np.flatnonzero(weights)[-1]).astype(np.uint16)
    return Guide(weights, table, quality.astype(np.float32), tries if np.ptp(quality, axis=1).any() else 1)


def mutate(genomes: Genomes, counts: Indices, guide: Guide, rng: np.random.Generator) -> Genomes:
    """Genomes (m, n) of which `counts` (m,) different genes each were drawn anew: of the tries that with the highest Q.

    Genes of no weight stay as they are.
    """
    mutants = genomes.copy()
    rows = np.flatnonzero(counts)
    if not len(rows):
        return mutants
    counts = np.minimum(counts[rows], np.count_nonzero(guide.weights))
    k = guide.marks.shape[1]
    size = len(rows) * guide.tries
    genes = _different_genes(int(counts.max()), size, guide, rng)
    parts = _draws(genes.size, rng).reshape(genes.shape) * np.uint32(k) >> np.uint32(16)
    cells = genes * np.uint32(k) + parts
    kept = _best_try(genomes[rows], counts, cells, guide) if guide.tries > 1 else np.arange(size)
    values = (parts[:, kept] + rng.random((len(genes), len(rows)))) / k
    for place, (gene, value) in enumerate(zip(genes[:, kept], values, strict=True)):
        changed = counts > place
        mutants[rows[changed], gene[changed]] = value[changed]
    return mutants


def _best_try(genomes: Genomes, counts: Indices, cells: NDArray[np.uint32], guide: Guide) -> Indices:
    """Index (m,) of the try of each genome (m, n) that gains most; `cells` (c, m * tries) are its genes and parts."""
    m, (n, k) = len(genomes), guide.marks.shape
    old = guide.marks[np.arange(n), np.minimum((genomes * k).astype(np.intp), k - 1)]
    gains = (guide.marks - old[:, :, None]).reshape(m, n * k)
    gained = np.zeros((m, guide.tries), np.float32)
    for place, cell in enumerate(cells.reshape(len(cells), m, guide.tries)):
        gain = np.take(gains, cell + n * k * np.arange(m)[:, None])
        gained += gain if counts.min() > place else gain * (counts > place)[:, None]
    best: Indices = gained.argmax(axis=1) + guide.tries * np.arange(m)
    return best


def _different_genes(count: int, size: int, guide: Guide, rng: np.random.Generator) -> NDArray[np.uint16]:
    """Genes (count, size), different in every column, one after another in proportion to the weights of those left."""
    genes = guide.table.take(_draws(count * size, rng)).reshape(count, size)
    for place in range(1, count):
        row, twice = genes[place], _twice(genes[:place], genes[place])
        before = genes[:place].take(twice, axis=1)
        for _ in range(REDRAWS):
            if not len(twice):
                break
            row[twice] = again = guide.table.take(_draws(len(twice), rng))
            still = _twice(before, again)
            twice, before = twice.take(still), before.take(still, axis=1)
        if len(twice):
            row[twice] = _one_left(before, guide.weights, rng)
    return genes


def _draws(count: int, rng: np.random.Generator) -> NDArray[np.uint16]:
    """Uniform draws (count,) of 16 bits, four of a word: a third of the time of `rng.integers`."""
    words: NDArray[np.uint64] = rng.bit_generator.random_raw(-(-count // 4))
    return words.view(np.uint16)[:count]


def _twice(drawn: NDArray[np.uint16], genes: NDArray[np.uint16]) -> Indices:
    """Columns (m,) whose gene is among the ones `drawn` (c, size) before."""
    twice = np.zeros(len(genes), bool)
    for row in drawn:
        twice |= row == genes
    return np.flatnonzero(twice)


def _one_left(drawn: NDArray[np.uint16], weights: Floats, rng: np.random.Generator) -> Indices:
    """Genes (m,) in proportion to the weights of those not in the columns of `drawn` (c, m)."""
    left = np.tile(weights, (drawn.shape[1], 1))
    np.put_along_axis(left, drawn.T.astype(np.intp), 0.0, axis=1)
    summed = left.cumsum(axis=1)
    wanted = rng.random((len(left), 1)) * summed[:, -1:]
    one: Indices = np.minimum((summed <= wanted).sum(axis=1), len(weights) - 1)
    return one
