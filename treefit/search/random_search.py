"""Random search: the baseline that every other optimiser must beat."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.search.archive import Archive
from treefit.search.hints import Hints, hints_for
from treefit.search.optimizer import Genomes, Scores, State
from treefit.search.start import Start, first_genomes, leading


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class RandomSearch:
    """Settings of random search: batches of uniform genomes, the first one as `start` says."""

    evaluations: int = Field(default=50_000, ge=1)
    batch: int = Field(default=400, ge=1)
    start: Start = "random"

    def begin(self, n_genes: int, seed: int, hints: Hints | None = None) -> RandomRun:
        """Optimizer for genomes of `n_genes` genes."""
        return RandomRun(self, n_genes, seed, hints)


class RandomRun:
    """Random search under way."""

    stage = "random"

    def __init__(self, settings: RandomSearch, n_genes: int, seed: int, hints: Hints | None) -> None:
        self.settings, self.n_genes, self.seed, self.told = settings, n_genes, seed, 0
        self.known = leading(settings.start, hints_for(n_genes, hints))
        self.archive = Archive(n_genes)
        self._asked: Genomes | None = None

    @property
    def done(self) -> bool:
        """Whether the budget of evaluations is spent."""
        return self.told >= self.settings.evaluations

    def ask(self) -> Genomes:
        """Uniform genomes; in the first batch those of the start."""
        if self._asked is not None:
            raise ValueError("ask: tell the scores of the last genomes first")
        rng = np.random.default_rng([self.seed, self.told])
        places = np.arange(min(self.settings.batch, self.settings.evaluations - self.told))
        self._asked = first_genomes("random" if self.told else self.settings.start, self.known, places, rng)
        return self._asked

    def floors(self) -> Scores:
        """Floor of the archive, for all."""
        if self._asked is None:
            raise ValueError("floors: ask for genomes first")
        return np.full(len(self._asked), self.archive.floor)

    def tell(self, scores: Scores) -> None:
        """Take the scores."""
        if self._asked is None or len(scores) != len(self._asked):
            raise ValueError(f"tell: needs one score for each genome asked, got {len(scores)}")
        self.archive.add(self._asked, scores)
        self.told += len(scores)
        self._asked = None

    def best(self, count: int) -> tuple[Genomes, Scores]:
        """Distinct best of the whole run."""
        return self.archive.best(count)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Archive and counter."""
        return {
            "archive_genomes": self.archive.genomes,
            "archive_scores": self.archive.scores,
            "told": np.array([self.told]),
        }

    def restore(self, state: State) -> None:
        """Go on from `state`."""
        self.archive.genomes = np.asarray(state["archive_genomes"], float)
        self.archive.scores = np.asarray(state["archive_scores"], float)
        self.told, self._asked = int(state["told"][0]), None
