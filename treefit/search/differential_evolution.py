"""Differential evolution of scipy (R. Storn and K. Price, 1997): a baseline.

Scipy's calls the function itself. It runs on a thread that waits while its genomes are scored elsewhere; one of the two
threads always waits for the other, so that the result does not depend on them.
"""

from __future__ import annotations

from collections.abc import Callable
from queue import SimpleQueue
from threading import Thread
from typing import Literal

import numpy as np
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.search.hints import Hints, hints_for
from treefit.search.optimizer import Genomes, Scores
from treefit.search.replay import Moves, Replay
from treefit.search.start import Start, first_genomes, leading

GENERATIONS = 10**9
"""Never reached: the budget of the search ends it."""

Step = Literal[
    "best1bin", "best1exp", "best2bin", "best2exp", "rand1bin", "rand1exp", "rand2bin", "rand2exp",
    "currenttobest1bin", "currenttobest1exp", "randtobest1bin", "randtobest1exp",
]  # fmt: skip
"""Scipy's names of the step."""


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class DifferentialEvolution:
    """Settings of differential evolution, in scipy's words: best1bin, a factor that is drawn every generation."""

    evaluations: int = Field(default=50_000, ge=1)
    population: int = Field(default=100, ge=5)
    strategy: Step = "best1bin"
    factor_low: float = Field(default=0.5, ge=0, lt=2)
    factor_high: float = Field(default=1.0, gt=0, lt=2)
    crossover: float = Field(default=0.7, ge=0, le=1)
    start: Start = "random"

    def begin(self, n_genes: int, seed: int, hints: Hints | None = None) -> Replay:
        """Optimizer for genomes of `n_genes` genes."""
        known = leading(self.start, hints_for(n_genes, hints))
        return Replay("differential evolution", lambda: _moves(self, known, seed), n_genes, self.evaluations)


def _moves(settings: DifferentialEvolution, known: Genomes, seed: int) -> Moves:
    """Of scipy's search; a new one begins where all scores are the same, which it takes for its end."""
    from scipy.optimize import differential_evolution  # a second, which no other search shall wait for

    start = 0
    while True:
        rng = np.random.default_rng([seed, start])
        first = first_genomes(settings.start, known, np.arange(settings.population), rng)

        def search(score: Callable[[Genomes], Scores], first: Genomes = first, rng: np.random.Generator = rng) -> None:
            differential_evolution(
                lambda columns: -score(columns.T), [(0.0, 1.0)] * first.shape[1], init=first, rng=rng,
                strategy=settings.strategy, mutation=(settings.factor_low, settings.factor_high),
                recombination=settings.crossover, maxiter=GENERATIONS, tol=0.0, atol=0.0,
                polish=False, vectorized=True, updating="deferred",
            )  # fmt: skip

        yield from turned_round(search)
        start += 1


class _Dropped(BaseException):
    """Ends a thread whose scores will never come."""


def turned_round(search: Callable[[Callable[[Genomes], Scores]], None]) -> Moves:
    """The moves of a search that calls its score function itself; dropped moves end its thread."""
    asked: SimpleQueue[Genomes | BaseException | None] = SimpleQueue()
    told: SimpleQueue[Scores | None] = SimpleQueue()
    thread = Thread(target=_searching, args=(search, asked, told), daemon=True, name="differential evolution")
    thread.start()
    try:
        while (genomes := asked.get()) is not None:
            if isinstance(genomes, BaseException):
                raise genomes
            told.put((yield genomes))
    finally:
        told.put(None)
        thread.join()


def _searching(
    search: Callable[[Callable[[Genomes], Scores]], None],
    asked: SimpleQueue[Genomes | BaseException | None], told: SimpleQueue[Scores | None],
) -> None:  # fmt: skip
    def score(genomes: Genomes) -> Scores:
        asked.put(np.array(genomes, order="C"))
        scores = told.get()
        if scores is None:
            raise _Dropped
        return scores

    try:
        search(score)
        asked.put(None)
    except _Dropped:
        return
    except BaseException as error:  # of scipy: told where the search is driven from
        asked.put(error)
