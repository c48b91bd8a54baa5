"""L-SHADE: differential evolution that learns its own settings, with a population that shrinks to a few.

R. Tanabe and A. S. Fukunaga, "Improving the search performance of SHADE using linear population size reduction", 2014.
"""

from __future__ import annotations

from dataclasses import dataclass as plain_dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.search.hints import Hints, hints_for
from treefit.search.optimizer import Genomes, Scores
from treefit.search.replay import Moves, Replay
from treefit.search.start import Start, first_genomes, leading

Floats = NDArray[np.float64]


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class LSHADE:
    """Settings of L-SHADE."""

    evaluations: int = Field(default=50_000, ge=1)
    population: int = Field(default=100, ge=4)
    min_population: int = Field(default=4, ge=4)
    memory: int = Field(default=6, ge=1)
    best_share: float = Field(default=0.11, gt=0, le=1)
    archive_share: float = Field(default=2.6, ge=0)
    start: Start = "random"

    def begin(self, n_genes: int, seed: int, hints: Hints | None = None) -> Replay:
        """Optimizer for genomes of `n_genes` genes."""
        known = leading(self.start, hints_for(n_genes, hints))
        return Replay("L-SHADE", lambda: _moves(self, known, seed), n_genes, self.evaluations)


@plain_dataclass
class Memory:
    """What worked lately: means of the draws of the crossover rate (h,), NaN once 0 for good, and step factor (h,)."""

    crossover: Floats
    factor: Floats
    at: int = 0

    def draw(self, count: int, rng: np.random.Generator) -> tuple[Floats, Floats]:
        """Crossover rates and step factors (count,) around entries that are drawn."""
        entry = rng.integers(len(self.factor), size=count)
        rate = np.nan_to_num(np.clip(rng.normal(self.crossover[entry], 0.1), 0.0, 1.0), nan=0.0)
        factor = np.zeros(count)
        while (low := np.flatnonzero(factor <= 0)).size:
            factor[low] = self.factor[entry[low]] + 0.1 * rng.standard_cauchy(len(low))
        return rate, np.minimum(factor, 1.0)

    def learn(self, crossover: Floats, factor: Floats, gains: Floats) -> None:
        """Take what led to the `gains` (m,) in score as weighted Lehmer means, in place of the oldest entry."""
        if not len(gains):
            return
        if np.isnan(self.crossover[self.at]) or crossover.max() == 0:
            self.crossover[self.at] = np.nan
        else:
            self.crossover[self.at] = gains @ crossover**2 / (gains @ crossover)
        self.factor[self.at] = gains @ factor**2 / (gains @ factor)
        self.at = (self.at + 1) % len(self.factor)


def population_at(settings: LSHADE, told: int) -> int:
    """Individuals after `told` evaluations: linear, down to the least at the end of the budget."""
    least = min(settings.min_population, settings.population)
    share = min(1.0, told / settings.evaluations)
    return round(settings.population + (least - settings.population) * share)


def _moves(settings: LSHADE, known: Genomes, seed: int) -> Moves:
    rng = np.random.default_rng([seed, 0])
    genomes = first_genomes(settings.start, known, np.arange(settings.population), rng)
    scores = yield genomes
    told, outlived = len(scores), genomes[:0]
    memory = Memory(np.full(settings.memory, 0.5), np.full(settings.memory, 0.5))
    while True:
        crossover, factor = memory.draw(len(genomes), rng)
        trials = _trials(genomes, scores, outlived, crossover, factor, settings.best_share, rng)
        results = yield trials
        told += len(results)
        better = results > scores
        memory.learn(crossover[better], factor[better], (results - scores)[better])
        outlived = np.concatenate([outlived, genomes[better]])
        taken = results >= scores
        genomes, scores = np.where(taken[:, None], trials, genomes), np.where(taken, results, scores)
        kept = np.sort(np.argsort(-scores, kind="stable")[: population_at(settings, told)])
        genomes, scores = genomes[kept], scores[kept]
        room = round(settings.archive_share * len(genomes))
        if len(outlived) > room:
            outlived = outlived[np.sort(rng.choice(len(outlived), room, replace=False))]


def _trials(
    genomes: Genomes, scores: Scores, outlived: Genomes, crossover: Floats, factor: Floats, share: float,
    rng: np.random.Generator,
) -> Genomes:  # fmt: skip
    """Trials (p, n) by current-to-pbest/1 with the individuals that were `outlived`, and binomial crossover."""
    p, n = genomes.shape
    order, own = np.argsort(-scores, kind="stable"), np.arange(p)
    best = genomes[order[rng.integers(max(2, round(share * p)), size=p)]]
    first = rng.integers(p - 1, size=p)
    first += first >= own  # any but oneself
    second = rng.integers(p + len(outlived) - 2, size=p)
    for other in (np.minimum(own, first), np.maximum(own, first)):  # any but these two
        second += second >= other
    everyone = np.concatenate([genomes, outlived])
    step = best - genomes + genomes[first] - everyone[second]
    mutants = genomes + factor[:, None] * step
    mutants = np.where(mutants < 0, genomes / 2, np.where(mutants > 1, (genomes + 1) / 2, mutants))
    crossed = rng.random((p, n)) < crossover[:, None]
    crossed[own, rng.integers(n, size=p)] = True
    return np.where(crossed, mutants, genomes)
