"""The paper's tree of elementary genetic algorithms (sec. 5, fig. 3), one level at a time.

Leaves start from random or known genomes, every other node from the fittest of its two children. All nodes of a level
form one (t, p, n) array, so that an ask is one large batch; each node has its own random stream. Kept of a population
are its survivors, the better half: only they have children, and no other can be in the better half of two joined ones.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.search.archive import Archive
from treefit.search.hints import Hints, hints_for
from treefit.search.operators import fittest, mutate, one_dot_crossover, pick_parents, uniform_crossover, without_twins
from treefit.search.optimizer import Genomes, Scores, State
from treefit.search.start import Start, first_genomes


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class TreeGA:
    """Settings of the tree of elementary GAs."""

    evaluations: int = Field(default=50_000, ge=1)
    population: int = Field(default=100, ge=4)
    start_population: int = Field(default=200, ge=4)
    generations: int = Field(default=75, ge=1)
    mutation_chance: float = Field(default=0.9, ge=0, le=1)
    mutation_genes: float = Field(default=0.05, gt=0, le=1)
    mutation_step: float = Field(default=0.1, gt=0, le=1)
    crossover: str = Field(default="one_dot", pattern="^(one_dot|uniform)$")
    start: Start = "mixed"

    def begin(self, n_genes: int, seed: int, hints: Hints | None = None) -> TreeGASearch:
        """Optimizer for genomes of `n_genes` genes."""
        return TreeGASearch(self, n_genes, seed, hints)


class TreeGASearch:
    """The tree of GAs under way; `level` counts down to 0, the root."""

    def __init__(self, settings: TreeGA, n_genes: int, seed: int, hints: Hints | None) -> None:
        self.settings, self.n_genes, self.seed = settings, n_genes, seed
        self.known = hints_for(n_genes, hints).known
        self.depth, self.survivors = _depth(settings), settings.population - settings.population // 2
        self.archive = Archive(n_genes)
        self.level, self.generation, self.told = self.depth - 1, 0, 0
        self.genomes: NDArray[np.float64] = np.empty((2**self.level, 0, n_genes))
        self.scores: NDArray[np.float64] = np.empty((2**self.level, 0))
        self._asked: Genomes | None = None

    @property
    def done(self) -> bool:
        """Whether the budget of evaluations is spent."""
        return self.told >= self.settings.evaluations

    @property
    def stage(self) -> str:
        """Level, elementary GAs in it, and generation."""
        return f"level {self.depth - self.level}/{self.depth}, {len(self.genomes)} x generation {self.generation}"

    def ask(self) -> Genomes:
        """Genomes of all nodes of the level: the first population, then half a population of children each."""
        if self._asked is not None:
            raise ValueError("ask: tell the scores of the last genomes first")
        first = self.generation == 0 and self.level == self.depth - 1
        streams = [
            np.random.default_rng([self.seed, self.level, node, self.generation]) for node in range(len(self.genomes))
        ]
        nodes = [self._first(node, rng) if first else self._children(node, rng) for node, rng in enumerate(streams)]
        self._asked = np.concatenate(nodes)[: self.settings.evaluations - self.told]
        return self._asked

    def floors(self) -> Scores:
        """Lower of two floors: that of the archive, and the worst survivor of the child's population."""
        if self._asked is None:
            raise ValueError("floors: ask for genomes first")
        if self.scores.shape[1] < self.survivors:
            return np.full(len(self._asked), -np.inf)
        floors = np.minimum(self.scores[:, -1], self.archive.floor)
        return np.repeat(floors, self.settings.population // 2)[: len(self._asked)]

    def tell(self, scores: Scores) -> None:
        """Take the scores; the worst half of each population makes room for the children."""
        if self._asked is None or len(scores) != len(self._asked):
            raise ValueError(f"tell: needs one score for each genome asked, got {len(scores)}")
        asked, self._asked = self._asked, None
        self.told += len(asked)
        self.archive.add(asked, scores)
        if self.done:  # the last batch, which the budget may have cut anywhere
            return
        nodes, n = self.genomes.shape[0], self.n_genes
        self._keep_fittest(np.concatenate([self.genomes, asked.reshape(nodes, -1, n)], axis=1),
                           np.concatenate([self.scores, scores.reshape(nodes, -1)], axis=1))  # fmt: skip
        self.generation += 1
        if self.level > 0 and self.generation > self._generations():  # the next level: of two populations the fittest
            self._keep_fittest(self.genomes.reshape(nodes // 2, -1, n), self.scores.reshape(nodes // 2, -1))
            self.level, self.generation = self.level - 1, 0

    def best(self, count: int) -> tuple[Genomes, Scores]:
        """Distinct best of the whole run."""
        return self.archive.best(count)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Survivors, archive and counters."""
        return {
            "genomes": self.genomes, "scores": self.scores, "archive_genomes": self.archive.genomes,
            "archive_scores": self.archive.scores, "counters": np.array([self.level, self.generation, self.told]),
        }  # fmt: skip

    def restore(self, state: State) -> None:
        """Go on from `state`."""
        self.genomes, self.scores = np.asarray(state["genomes"], float), np.asarray(state["scores"], float)
        self.archive.genomes = np.asarray(state["archive_genomes"], float)
        self.archive.scores = np.asarray(state["archive_scores"], float)
        self.level, self.generation, self.told = (int(number) for number in state["counters"])
        self._asked = None

    def _first(self, node: int, rng: np.random.Generator) -> Genomes:
        places = node + len(self.genomes) * np.arange(self.settings.start_population)  # deals the known ones out
        return first_genomes(self.settings.start, self.known, places, rng)

    def _children(self, node: int, rng: np.random.Generator) -> Genomes:
        s, genomes = self.settings, self.genomes[node]
        parents = pick_parents(self.scores[node], s.population // 2, rng)
        cross = one_dot_crossover if s.crossover == "one_dot" else uniform_crossover
        children = cross(genomes[parents[:, 0]], genomes[parents[:, 1]], rng)
        mutants = mutate(children, s.mutation_chance, s.mutation_genes, s.mutation_step, rng)
        return without_twins(mutants, genomes, lambda twins: mutate(twins, 1.0, s.mutation_genes, s.mutation_step, rng))

    def _keep_fittest(self, genomes: NDArray[np.float64], scores: NDArray[np.float64]) -> None:
        """Let the fittest of each of the populations (t, p, n) survive."""
        kept = [fittest(g, s, self.survivors) for g, s in zip(genomes, scores, strict=True)]
        self.genomes, self.scores = np.stack([g for g, _ in kept]), np.stack([s for _, s in kept])

    def _generations(self) -> int:
        """Generations of every node, so that the budget is spent; the root takes what is left over."""
        leaves = 1 << (self.depth - 1)
        nodes = 2 * leaves - 1
        spent = leaves * self.settings.start_population
        return max(1, (self.settings.evaluations - spent) // (nodes * (self.settings.population // 2)))


def _depth(settings: TreeGA) -> int:
    """Depth of the tree at which every node has at most about the wanted generations."""
    calls = settings.generations * (settings.population // 2)
    depth, total = 1, settings.start_population + calls
    while total < settings.evaluations:
        depth, total = depth + 1, 2 * total + calls
    return depth
