"""Progress: what a search has come to, and what a checkpoint keeps besides the optimiser's own state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from treefit.improvements import Improvement, joined
from treefit.objective import UNGROWN, Objective, Score
from treefit.plant import Values


@dataclass(frozen=True)
class Generation:
    """What is known after a batch of evaluations; `seconds` and the rate count all sessions of a resumed run.

    Failures and the undrawn are counted from the start of the run; `mean` is that of the batch without the undrawn.
    """

    number: int
    stage: str
    evaluations: int
    best: float
    best_image: float
    mean: float
    failures: int
    undrawn: int
    seconds: float
    evaluations_per_second: float


@dataclass(frozen=True)
class Failure:
    """A candidate that could not be scored."""

    reason: str
    values: Values
    seed: int


@dataclass
class Progress:
    """Generations so far, failures counted by kind, the reason of the first one, the best score and how it came."""

    history: list[Generation] = field(default_factory=list)
    failures: dict[str, int] = field(default_factory=dict)
    first_failure: str = ""
    best: Score = field(default_factory=lambda: Score(0.0))
    improvements: list[Improvement] = field(default_factory=list)

    @classmethod
    def from_json(cls, kept: Mapping[str, Any]) -> Progress:
        """Progress from what `dataclasses.asdict` made of one."""
        history = [Generation(**line) for line in kept["history"]]
        improvements = [Improvement.from_json(one) for one in kept.get("improvements", ())]
        return cls(history, kept["failures"], kept["first_failure"], Score(**kept["best"]), improvements)

    @property
    def seconds(self) -> float:
        """Seconds of the search so far."""
        return self.history[-1].seconds if self.history else 0.0

    @property
    def evaluations(self) -> int:
        """Plants grown so far."""
        return self.history[-1].evaluations if self.history else 0

    def count(self, failure: Failure) -> None:
        """Count `failure` by its kind, the words before the first colon."""
        kind = failure.reason.partition(":")[0]
        self.failures[kind] = self.failures.get(kind, 0) + 1
        self.first_failure = self.first_failure or failure.reason

    def add(
        self, stage: str, objective: Objective, genomes: NDArray[np.float64], scores: list[Score], seconds: float,
        plants: int | None = None,
    ) -> list[Failure]:  # fmt: skip
        """Take in a generation that ended after `seconds`, with `plants`, one a score if None; return what failed.

        What nobody tried to grow is left out.
        """
        tried = [i for i, score in enumerate(scores) if not (score.failure or "").startswith(UNGROWN)]
        genomes, scores = genomes[tried], [scores[i] for i in tried]
        failed = [(genome, score) for genome, score in zip(genomes, scores, strict=True) if score.failure is not None]
        failures = [
            Failure(str(score.failure), objective.space.decode(genome), objective.seed) for genome, score in failed
        ]
        for failure in failures:
            self.count(failure)
        done, undrawn = (self.evaluations, self.history[-1].undrawn) if self.history else (0, 0)
        drawn = [score.total for score in scores if score.drawn]
        done, undrawn = done + (len(scores) if plants is None else plants), undrawn + len(scores) - len(drawn)
        best, genome = max(zip(scores, genomes, strict=True), key=lambda pair: pair[0].total)
        if best.total > self.best.total:
            found = Improvement(done, best.total, best.image, tuple(genome.tolist()))
            self.best, self.improvements = best, joined(self.improvements, found)
        mean = sum(drawn) / max(len(drawn), 1)
        self.history.append(
            Generation(len(self.history), stage, done, self.best.total, self.best.image, mean,
                       sum(self.failures.values()), undrawn, seconds, done / max(seconds, 1e-9))
        )  # fmt: skip
        return failures
