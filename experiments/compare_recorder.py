"""Recorder: an optimiser that is watched: how good the best is after every evaluation, and its own time."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from treefit.search import Hints, Optimizer, Strategy
from treefit.search.optimizer import Genomes, Scores, State

Answer = TypeVar("Answer")


@dataclass
class Record:
    """Counts of evaluations at which the best score rose, the score then; processor times in seconds.

    `own` is what the optimiser takes itself, `total` that with the evaluations.
    """

    steps: list[int] = field(default_factory=list)
    scores: list[float] = field(default_factory=list)
    evaluations: int = 0
    own: float = 0.0
    total: float = 0.0

    def add(self, scores: Scores) -> None:
        """Take in the scores of the next evaluations, in order."""
        best = self.scores[-1] if self.scores else -np.inf
        for i in np.flatnonzero(scores > best):
            if scores[i] > best:
                best = float(scores[i])
                self.steps.append(self.evaluations + int(i) + 1)
                self.scores.append(best)
        self.evaluations += len(scores)


@dataclass(frozen=True)
class Recorded:
    """Strategy whose optimisers write to `record`."""

    strategy: Strategy
    record: Record

    @property
    def evaluations(self) -> int:
        """Budget of the strategy."""
        return self.strategy.evaluations

    def begin(self, n_genes: int, seed: int, hints: Hints | None = None) -> Optimizer:
        """Watched optimizer."""
        started = time.process_time()
        search = self.strategy.begin(n_genes, seed, hints)
        self.record.own = self.record.total = time.process_time() - started
        return Recorder(search, self.record)


class Recorder:
    """Optimizer that does what `search` does, watched."""

    def __init__(self, search: Optimizer, record: Record) -> None:
        self._search, self._record = search, record
        self._last: float | None = None

    @property
    def done(self) -> bool:
        """Whether the budget of evaluations is spent."""
        return self._search.done

    @property
    def stage(self) -> str:
        """Where the search is."""
        return self._search.stage

    def ask(self) -> Genomes:
        """Genomes to score."""
        if self._last is None:
            self._last = time.process_time()
        return self._timed(self._search.ask)

    def floors(self) -> Scores:
        """Scores under which all is the same."""
        return self._timed(self._search.floors)

    def tell(self, scores: Scores) -> None:
        """Take the scores."""
        self._record.add(scores)
        self._timed(lambda: self._search.tell(scores))

    def best(self, count: int) -> tuple[Genomes, Scores]:
        """Return the distinct best."""
        return self._search.best(count)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return the state of the search."""
        return self._search.state()

    def restore(self, state: State) -> None:
        """Go on from `state`."""
        self._search.restore(state)

    def _timed(self, call: Callable[[], Answer]) -> Answer:
        started = time.process_time()
        answer = call()
        now = time.process_time()
        self._record.own += now - started
        if self._last is not None:
            self._record.total += now - self._last
            self._last = now
        return answer
