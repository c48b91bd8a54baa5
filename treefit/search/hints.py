"""Hints: what is known before a search, of the family of functions that its function is from, and of this one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Genomes = NDArray[np.float64]  # (m, n) in [0, 1]
Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Hints:
    """Hints for genomes of n genes; `Hints.none(n)` knows nothing.

    `known` (m, n): genomes that are good for other members of the family (presets, earlier runs), the likeliest first.
    `rate` (n,): V(k), how fast the function changes with a gene (sec. 5), not negative; all equal when not known.
    `quality` (n, k): Q(i, j), marks of gene i in the j-th of k equal parts of [0, 1] (sec. 5); all 0 when not known.
    `guess` (g, n): genomes that the target itself suggests, the likeliest first.
    """

    known: Genomes
    rate: Floats
    quality: Floats
    guess: Genomes

    def __post_init__(self) -> None:
        n = len(self.rate)
        for name, genomes in (("known", self.known), ("guess", self.guess)):
            if genomes.ndim != 2 or genomes.shape[1] != n:
                raise ValueError(f"{name} genomes: must have the shape (m, {n}), got {genomes.shape}")
            if not ((genomes >= 0) & (genomes <= 1)).all():
                raise ValueError(f"{name} genomes: genes must be in [0, 1]")
        if self.quality.ndim != 2 or len(self.quality) != n:
            raise ValueError(f"hints: quality must be of {n} genes")
        if not (np.isfinite(self.rate).all() and (self.rate >= 0).all() and np.isfinite(self.quality).all()):
            raise ValueError("hints: rates must be finite and not negative, marks finite")

    @classmethod
    def none(cls, n_genes: int) -> Hints:
        """Hints that say nothing."""
        nothing = np.empty((0, n_genes))
        return cls(nothing, np.ones(n_genes), np.zeros((n_genes, 1)), nothing)

    def __len__(self) -> int:
        """Count of genes."""
        return len(self.rate)

    @property
    def arrays(self) -> Sequence[Floats]:
        """All that is known, in order."""
        return self.known, self.rate, self.quality, self.guess

    def mark(self, genomes: Genomes) -> Floats:
        """Q(G), the sum of the marks of the genes, of genomes (m, n) as (m,) (sec. 5)."""
        n, k = self.quality.shape
        part = np.minimum((genomes * k).astype(np.intp), k - 1)
        return np.asarray(self.quality[np.arange(n), part].sum(axis=-1))


def hints_for(n_genes: int, hints: Hints | None) -> Hints:
    """Return `hints`, or none; ValueError when they are of another count of genes."""
    if hints is None:
        return Hints.none(n_genes)
    if len(hints) != n_genes:
        raise ValueError(f"hints: must be of {n_genes} genes, got {len(hints)}")
    return hints
