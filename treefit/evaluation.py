"""Evaluation: genomes become scores in parallel; the only place that knows joblib."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from joblib import Parallel, cpu_count, delayed
from numpy.typing import NDArray
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.objective import Objective, Score

BACKENDS = {"threads": "threading", "processes": "loky", "serial": "sequential"}


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Evaluator:
    """Scores batches on `workers` workers (0: one a core); the result never depends on their number.

    `kind` auto takes threads where generator and view release the GIL, processes where one of them does not.
    """

    kind: str = Field(default="auto", pattern="^(auto|serial|threads|processes)$")
    workers: int = Field(default=0, ge=0, le=1024)
    chunk: int = Field(default=32, ge=1)  # genomes a task, at most

    def __call__(self, objective: Objective, genomes: NDArray[np.float64]) -> list[Score]:
        """Scores of `genomes` (m, n), in order."""
        workers = self.workers or cpu_count()
        size = max(1, min(self.chunk, -(-len(genomes) // workers)))
        chunks = [genomes[i : i + size] for i in range(0, len(genomes), size)]
        backend = BACKENDS[self.backend(objective)]
        try:
            parts = Parallel(n_jobs=workers, backend=backend)(delayed(_score)(objective, chunk) for chunk in chunks)
        except Exception as error:  # a worker died: find out whose fault it was
            if backend != "loky":
                raise
            return self._one_by_one(objective, genomes, f"{type(error).__name__}")
        return [score for part in parts for score in part]

    def backend(self, objective: Objective) -> str:
        """Return threads, processes or serial for `objective`."""
        if self.kind != "auto":
            return self.kind
        both = (objective.generator.parallel, objective.view.parallel)
        return "threads" if both == ("threads", "threads") else "processes"

    def _one_by_one(self, objective: Objective, genomes: NDArray[np.float64], reason: str) -> list[Score]:
        scores = []
        for genome in genomes:
            try:
                scores += Parallel(n_jobs=2, backend="loky")([delayed(_score)(objective, [genome])])[0]
            except Exception:
                scores.append(Score(0.0, failure=f"the worker process died ({reason})"))
        return scores


def _score(objective: Objective, genomes: Sequence[NDArray[np.float64]]) -> list[Score]:
    return [objective(genome) for genome in genomes]
