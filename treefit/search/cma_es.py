"""CMA-ES: a normal distribution that turns and stretches towards better genomes (N. Hansen, arXiv:1604.00772).

The best of a first population, random or led by known genomes, is where it begins. Draws outside the unit cube are
mirrored back into it. Once the distribution has shrunk the search starts again, round and wide, around the best so far:
the next hill is often higher.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field, ValidationInfo, field_validator
from pydantic.dataclasses import dataclass

from treefit.search.archive import Archive
from treefit.search.gaussian import Gaussian, around, learn, rates
from treefit.search.hints import Hints, hints_for
from treefit.search.operators import mirrored
from treefit.search.optimizer import Genomes, Scores, State
from treefit.search.start import Start, first_genomes, leading

START_BATCH = 100
"""Genomes of one ask of the first population: each batch knows the floor of the ones before."""


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class CMAES:
    """Settings of CMA-ES; as they are, those of optimizer=treefit: quick from a guess, then ever larger populations."""

    evaluations: int = Field(default=50_000, ge=1)
    start_share: float = Field(default=0.1, ge=0, le=1)
    start_most: int = Field(default=100, ge=1)
    generations: int = Field(default=100_000, ge=1)
    min_population: int = Field(default=16, ge=4)
    max_population: int = Field(default=16, ge=4)
    growth: float = Field(default=2.0, ge=1, le=10)
    step: float = Field(default=0.2, gt=0, le=1)
    known_step: float = Field(default=0.1, gt=0, le=1)
    converged: float = Field(default=0.005, gt=0, le=1)
    restart_step: float = Field(default=0.15, gt=0, le=1)
    start: Start = "guess"

    @field_validator("max_population")
    @classmethod
    def _not_under_the_least(cls, most: int, info: ValidationInfo) -> int:
        if most < info.data.get("min_population", most):
            raise ValueError(f"must not be under min_population, {info.data['min_population']}, got {most}")
        return most

    def begin(self, n_genes: int, seed: int, hints: Hints | None = None) -> CMAESSearch:
        """Optimizer for genomes of `n_genes` genes."""
        return CMAESSearch(self, n_genes, seed, hints)


class CMAESSearch:
    """CMA-ES under way; `gaussian` is None during the first population."""

    def __init__(self, settings: CMAES, n_genes: int, seed: int, hints: Hints | None) -> None:
        self.settings, self.n_genes, self.seed = settings, n_genes, seed
        self.known = leading(settings.start, hints_for(n_genes, hints))
        self.first = max(1, min(round(settings.start_share * settings.evaluations), settings.start_most))
        self.archive, self.told, self.restarts = Archive(n_genes), 0, 0
        self.rates = rates(n_genes, self.population)
        self.gaussian: Gaussian | None = None
        self._normals: NDArray[np.float64] = np.empty((0, n_genes))
        self._asked: Genomes | None = None

    @property
    def population(self) -> int:
        """Draws of a generation."""
        s = self.settings
        wanted = (s.evaluations - self.first) // s.generations
        return round(min(max(s.min_population, wanted), s.max_population) * s.growth**self.restarts)

    @property
    def done(self) -> bool:
        """Whether the budget of evaluations is spent."""
        return self.told >= self.settings.evaluations

    @property
    def stage(self) -> str:
        """Restart, generation and how far the search still reaches."""
        if self.gaussian is None:
            return "first genomes"
        reach = float(np.median(self.gaussian.spread))
        return f"start {self.restarts + 1}, generation {self.gaussian.generation}, spread {reach:.3f}"

    def ask(self) -> Genomes:
        """The first population in batches, then draws of the distribution."""
        if self._asked is not None:
            raise ValueError("ask: tell the scores of the last genomes first")
        left = self.settings.evaluations - self.told
        if self.gaussian is None:
            places = self.told + np.arange(min(START_BATCH, self.first - self.told, left))
            rng = np.random.default_rng([self.seed, self.told])
            self._asked = first_genomes(self.settings.start, self.known, places, rng)
            return self._asked
        g = self.gaussian
        rng = np.random.default_rng([self.seed, self.restarts, g.generation, 1])
        self._normals = rng.standard_normal((self.population, self.n_genes))
        self._asked = mirrored(g.place(g.steps(self._normals)))[:left]
        return self._asked

    def floors(self) -> Scores:
        """Floor of the archive in the first population, whose best alone matters; later every rank matters."""
        if self._asked is None:
            raise ValueError("floors: ask for genomes first")
        return np.full(len(self._asked), self.archive.floor if self.gaussian is None else -np.inf)

    def tell(self, scores: Scores) -> None:
        """Take the scores; the distribution learns from their order."""
        if self._asked is None or len(scores) != len(self._asked):
            raise ValueError(f"tell: needs one score for each genome asked, got {len(scores)}")
        asked, self._asked = self._asked, None
        self.told += len(asked)
        self.archive.add(asked, scores)
        if self.done:  # the last batch, which the budget may have cut anywhere
            return
        if self.gaussian is not None:
            order = np.argsort(-scores, kind="stable")
            self.gaussian = learn(self.gaussian, self.rates, self._normals[order])
            if np.median(self.gaussian.spread) < self.settings.converged:
                self.restarts += 1
                self.rates = rates(self.n_genes, self.population)
                self.gaussian = around(self._best_known(), self.settings.restart_step)
        elif self.told >= self.first:
            led = self.settings.start != "random" and len(self.known) > 0
            self.gaussian = around(self._best_known(), self.settings.known_step if led else self.settings.step)

    def best(self, count: int) -> tuple[Genomes, Scores]:
        """Distinct best of the whole run."""
        return self.archive.best(count)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Distribution, if there is one yet, archive and counters."""
        shape = {} if self.gaussian is None else vars(self.gaussian)
        return {
            **{name: np.array(value) for name, value in shape.items()},
            "archive_genomes": self.archive.genomes, "archive_scores": self.archive.scores,
            "counters": np.array([self.told, self.restarts]),
        }  # fmt: skip

    def restore(self, state: State) -> None:
        """Go on from `state`."""
        self.archive.genomes = np.asarray(state["archive_genomes"], float)
        self.archive.scores = np.asarray(state["archive_scores"], float)
        self.told, self.restarts = (int(number) for number in state["counters"])
        self.rates = rates(self.n_genes, self.population)
        self.gaussian, self._asked = None, None
        if "mean" in state:
            self.gaussian = Gaussian(
                mean=np.asarray(state["mean"], float), sigma=float(state["sigma"]),
                scale=np.asarray(state["scale"], float), covariance=np.asarray(state["covariance"], float),
                axes=np.asarray(state["axes"], float), lengths=np.asarray(state["lengths"], float),
                sigma_path=np.asarray(state["sigma_path"], float),
                scale_path=np.asarray(state["scale_path"], float),
                covariance_path=np.asarray(state["covariance_path"], float), generation=int(state["generation"]),
            )  # fmt: skip

    def _best_known(self) -> NDArray[np.float64]:
        genomes, _ = self.archive.best(1)
        return genomes[0] if len(genomes) else np.full(self.n_genes, 0.5)
