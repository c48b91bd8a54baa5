"""CMA-ES of the package `cma` (N. Hansen's own), with restarts: a baseline.

Draws outside the unit cube are mirrored back into it, which takes half the time of the package's own bounds.
"""

from __future__ import annotations

import numpy as np
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.search.hints import Hints, hints_for
from treefit.search.operators import mirrored
from treefit.search.optimizer import Genomes
from treefit.search.replay import Moves, Replay
from treefit.search.start import Start, first_genomes, leading


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class PyCMA:
    """Settings of CMA-ES of the package `cma`; every start is from one genome of `start`, by default a uniform one."""

    evaluations: int = Field(default=50_000, ge=1)
    population: int = Field(default=48, ge=4)
    step: float = Field(default=0.3, gt=0, le=1)
    converged: float = Field(default=0.001, ge=0)
    start: Start = "random"

    def begin(self, n_genes: int, seed: int, hints: Hints | None = None) -> Replay:
        """Optimizer for genomes of `n_genes` genes."""
        known = leading(self.start, hints_for(n_genes, hints))
        return Replay("cma", lambda: _moves(self, known, seed), n_genes, self.evaluations)


def _moves(settings: PyCMA, known: Genomes, seed: int) -> Moves:
    import cma  # with it comes pyplot: over a second, which no other search shall wait for

    start = 0
    while True:
        rng = np.random.default_rng([seed, start])
        place = first_genomes(settings.start, known, np.array([start]), rng)[0]
        strategy = cma.CMAEvolutionStrategy(place, settings.step, _options(settings, rng))
        while not strategy.stop():
            genomes = strategy.ask()
            scores = yield mirrored(np.array(genomes))
            strategy.tell(genomes, list(-scores))
        start += 1


def _options(settings: PyCMA, rng: np.random.Generator) -> dict[str, object]:
    """Options of `cma`: draws from `rng`, so that numpy's global ones are neither used nor changed; nothing printed."""
    return {
        "popsize": settings.population, "tolx": settings.converged,
        "randn": lambda *shape: rng.standard_normal(shape), "seed": np.nan,
        "verbose": -9, "verb_log": 0, "verb_disp": 0,
    }  # fmt: skip
