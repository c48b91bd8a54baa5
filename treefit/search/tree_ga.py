"""The paper's tree of elementary genetic algorithms (sec. 5, fig. 3), one level at a time.

Its settings as they stand are the paper's; others are those of its authors' program, or of a plain genetic algorithm.
Leaves start from random genomes, every other node from the fittest of its two children. All nodes of a level
form one (t, p, n) array, so that an ask is one large batch; each node has its own random stream. Kept of a population
are its survivors, the better half: only they have children, and no other can be in the better half of two joined ones.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.search.archive import Archive
from treefit.search.hints import Hints, hints_for
from treefit.search.mutation import guide, mutate
from treefit.search.operators import fittest, one_dot_crossover, pick_parents, uniform_crossover, without_twins
from treefit.search.optimizer import Genomes, Scores, State
from treefit.search.start import Start, first_genomes, leading, promising


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class TreeGA:
    """Settings of the tree of elementary GAs; a `depth` of 0 follows from the budget and the wanted generations."""

    evaluations: int = Field(default=50_000, ge=1)
    population: int = Field(default=100, ge=4)
    start_population: int = Field(default=200, ge=4)
    generations: int = Field(default=75, ge=1)
    depth: int = Field(default=0, ge=0, le=16)
    start: Start = "random"
    start_tries: int = Field(default=1, ge=1)
    fitness_growth: float = Field(default=0.0, ge=0)
    fitness_least: float = Field(default=0.0, ge=0)
    crossover: Literal["one_dot", "uniform"] = "one_dot"
    mutation_chance: float = Field(default=0.5, ge=0, le=1)
    mutation_always: int = Field(default=0, ge=0)
    mutation_genes: float = Field(default=0.1, gt=0, le=1)
    mutation_count: Literal["constant", "uniform"] = "constant"
    guided: bool = True
    rate_floor: float = Field(default=0.0, ge=0)
    tries: int = Field(default=500, ge=1)

    def begin(self, n_genes: int, seed: int, hints: Hints | None = None) -> TreeGASearch:
        """Optimizer for genomes of `n_genes` genes."""
        return TreeGASearch(self, n_genes, seed, hints)


class TreeGASearch:
    """The tree of GAs under way; `level` counts down to 0, the root."""

    def __init__(self, settings: TreeGA, n_genes: int, seed: int, hints: Hints | None) -> None:
        self.settings, self.n_genes, self.seed = settings, n_genes, seed
        self.hints, nothing = hints_for(n_genes, hints), Hints.none(n_genes)
        led = self.hints if settings.guided else nothing
        self.guide = guide(led.rate, led.quality, settings.rate_floor, settings.tries)
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
            self.level, self.generation = self.level - 1, 1

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
        s = self.settings
        places = node + len(self.genomes) * np.arange(s.start_population)  # deals the known ones out
        uniform = promising(self.hints, s.start_population, s.start_tries, rng)
        return first_genomes(s.start, leading(s.start, self.hints), places, rng, uniform)

    def _children(self, node: int, rng: np.random.Generator) -> Genomes:
        s, genomes = self.settings, self.genomes[node]
        power = 1 + s.fitness_growth * (self.generation - 1)
        parents = pick_parents(self.scores[node], s.population // 2, rng, power, s.fitness_least)
        cross = one_dot_crossover if s.crossover == "one_dot" else uniform_crossover
        children = cross(genomes[parents[:, 0]], genomes[parents[:, 1]], rng)
        chance = 1.0 if self.generation <= s.mutation_always else s.mutation_chance
        mutants = self._mutated(children, chance, rng)
        return without_twins(mutants, genomes, lambda twins: self._mutated(twins, 1.0, rng))

    def _mutated(self, genomes: Genomes, chance: float, rng: np.random.Generator) -> Genomes:
        """Each with probability `chance` changed in a constant count of genes, or one that is drawn."""
        m, wanted = len(genomes), self.n_genes * self.settings.mutation_genes
        if self.settings.mutation_count == "constant":
            counts = np.full(m, max(1, round(wanted)))
        else:
            counts = (1 + wanted * rng.random(m)).astype(np.intp)
        return mutate(genomes, np.where(rng.random(m) < chance, counts, 0), self.guide, rng)

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
    """Depth of the tree, the wanted one or that at which every node has at most about the wanted generations."""
    if settings.depth:
        return settings.depth
    calls = settings.generations * (settings.population // 2)
    depth, total = 1, settings.start_population + calls
    while total < settings.evaluations:
        depth, total = depth + 1, 2 * total + calls
    return depth
