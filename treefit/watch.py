"""Watch: whether a foreign generator still lives, seen by what comes of batches that are handed on in slices."""

from __future__ import annotations

import logging
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.evaluation import Batch, Evaluator
from treefit.objective import OVER_BUDGET, UNGROWN, Score
from treefit.plant import Generator

MOST = 200
"""Failures in a row, however quick, after which a generator is held to be dead."""

SLOW = ((16, 20.0), (8, 120.0))
"""The same where each is waited for: failures in a row, and the seconds that they take at least."""

STILLBORN = (8, 20.0)
"""The same before there was any plant."""

WARY, AT_EASE = 4, 16
"""Genomes of a slice for every worker: after at least so many failures, and otherwise."""

_log = logging.getLogger(__name__)


@dataclass
class Watch:
    """Counts failures in a row; once there are too many, the generator is `dead` and nothing more is grown.

    One that is `pure` is not watched: what its values give is no news of it. A plant over the budget is no failure,
    for what grew it lives. `skipped` counts the plants of batches that were not grown.
    """

    workers: int
    pure: bool = False
    dead: bool = False
    skipped: int = 0
    _in_a_row: int = 0
    _seconds: float = 0.0
    _lived: bool = False

    @classmethod
    def of(cls, generator: Generator, evaluator: Evaluator) -> Watch:
        """Watch over `generator`, whose plants `evaluator` scores."""
        return cls(evaluator.at_once, generator.pure)

    @property
    def in_doubt(self) -> bool:
        """Whether the last plant failed: who goes on when the generator lives again had better not know of it."""
        return self._in_a_row > 0

    def over(self, batch: Batch) -> Batch:
        """Return `batch` by slices, small ones in doubt; after the death, scores of 0 with the failure UNGROWN."""
        if self.pure:
            return batch

        def watched(genomes: NDArray[np.float64], floors: NDArray[np.float64]) -> list[Score]:
            scores: list[Score] = []
            while len(scores) < len(genomes) and not self.dead:
                end = len(scores) + self.workers * (AT_EASE if self._lived and self._in_a_row < WARY else WARY)
                started = time.perf_counter()
                found = batch(genomes[len(scores) : end], floors[len(scores) : end])
                scores += found[: self._seen(found, time.perf_counter() - started)]
            missing = len(genomes) - len(scores)
            self.skipped += missing
            return scores + missing * [Score(0.0, failure=UNGROWN)]

        return watched

    def _seen(self, scores: list[Score], seconds: float) -> int:
        """Take in the scores of a slice; return how many count: with any workers it ends at the same one."""
        self._seconds += seconds
        for i, score in enumerate(scores):
            failed = score.failure is not None and not score.failure.startswith(OVER_BUDGET)
            self._in_a_row = self._in_a_row + 1 if failed else 0
            self._seconds = self._seconds if failed else 0.0
            self._lived = self._lived or not failed
            if self._in_a_row >= MOST:
                self._die(score)
                return i + 1
        rules = SLOW if self._lived else (*SLOW, STILLBORN)
        if any(self._in_a_row >= most and self._seconds >= least for most, least in rules):
            self._die(scores[-1])
        return len(scores)

    def _die(self, last: Score) -> None:
        self.dead = True
        _log.warning("the generator failed %d times in a row: the search ends here; the last reason: %s",
                     self._in_a_row, last.failure)  # fmt: skip
