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

    @property
    def floor(self) -> float:
        """Score at or under which no candidate of the next `add` is taken in; 0 while there is room."""
        return float(self.scores[-1]) if len(self.scores) == self.capacity else 0.0

    def add(self, genomes: Genomes, scores: Scores) -> None:
        """Take in the candidates (m, n) that are over the floor."""
        floor = self.floor  # of before: one that replaces two makes room, which is not for those known to be hopeless
        order = np.argsort(-scores, kind="stable")
        order = order[scores[order] > floor]
        for i in order[:1]:
            self._add_one(genomes[i], float(scores[i]))
        apart = genomes[order[1:]] - self.genomes[:1]  # from the best, which is known now: none near it is taken in
        for i in order[1:][np.einsum("ij,ij->i", apart, apart) >= self.distance**2 * genomes.shape[1]]:
            if scores[i] <= self.floor:
                return
            self._add_one(genomes[i], float(scores[i]))

    def _add_one(self, genome: Genomes, score: float) -> None:
        apart = self.genomes - genome
        kept = np.einsum("ij,ij->i", apart, apart) >= self.distance**2 * len(genome)
        at = int(np.searchsorted(-self.scores, -score, side="right"))
        if not kept[:at].all():  # near to a better one
            return
        better, worse = slice(at), np.flatnonzero(kept[at:]) + at
        self.genomes = np.concatenate([self.genomes[better], genome[None], self.genomes[worse]])[: self.capacity]
        self.scores = np.concatenate([self.scores[better], [score], self.scores[worse]])[: self.capacity]

    def best(self, count: int) -> tuple[Genomes, Scores]:
        """At most `count` genomes and scores, best first."""
        return self.genomes[:count].copy(), self.scores[:count].copy()
