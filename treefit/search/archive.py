"""Archive: the best genomes seen that differ from each other, kept over the whole run."""

from __future__ import annotations

import numpy as np

from treefit.search.optimizer import Genomes, Scores


class Archive:
    """At most `capacity` genomes, each at least `distance` (root mean square over the genes) from any better one."""

    def __init__(self, n_genes: int, capacity: int = 64, distance: float = 0.12) -> None:
        self.capacity, self.distance = capacity, distance
        self.genomes: Genomes = np.empty((0, n_genes))
        self.scores: Scores = np.empty(0)

    def add(self, genomes: Genomes, scores: Scores) -> None:
        """Take in the candidates (m, n) that are good enough; candidates of score 0 never are."""
        for i in np.argsort(-scores, kind="stable"):
            floor = self.scores[-1] if len(self.scores) == self.capacity else 0.0
            if scores[i] <= floor:
                return
            self._add_one(genomes[i], float(scores[i]))

    def _add_one(self, genome: Genomes, score: float) -> None:
        near = np.sqrt(np.mean((self.genomes - genome) ** 2, axis=1)) < self.distance
        if (self.scores[near] >= score).any():
            return
        kept = ~near
        at = int(np.searchsorted(-self.scores[kept], -score, side="right"))
        self.genomes = np.insert(self.genomes[kept], at, genome, axis=0)[: self.capacity]
        self.scores = np.insert(self.scores[kept], at, score)[: self.capacity]

    def best(self, count: int) -> tuple[Genomes, Scores]:
        """At most `count` genomes and scores, best first."""
        return self.genomes[:count].copy(), self.scores[:count].copy()
