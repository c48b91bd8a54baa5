"""Listeners: who is told, batch by batch, what a search has come to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from treefit.improvements import Improvement
from treefit.objective import Objective
from treefit.progress import Failure, Generation, Progress

OnGeneration = Callable[[Generation, list[Failure]], None]
"""Function that is told of each batch and of what failed in it."""

OnImprovement = Callable[[Improvement, Objective], None]
"""Function that is told of each new best plant, `objective.grow(genome, objective.seed)`, before of its batch."""


OnLeftOut = Callable[[int, Failure], None]
"""Function that is told of a genome that cannot be grown again, with the number of generations so far."""


@dataclass
class Listeners:
    """Functions that are told; those that nobody gave are None."""

    objective: Objective
    on_generation: OnGeneration | None = None
    on_improvement: OnImprovement | None = None
    on_left_out: OnLeftOut | None = None
    _told: Improvement | None = None

    def tell(self, progress: Progress, failures: list[Failure]) -> None:
        """Tell of the last batch of `progress`, and of its best plant when it is another one than the last time."""
        best = progress.improvements[-1] if progress.improvements else None
        if self.on_improvement is not None and best is not None and best is not self._told:
            self._told = best
            self.on_improvement(best, self.objective)
        if self.on_generation is not None:
            self.on_generation(progress.history[-1], failures)

    def left_out(self, progress: Progress, failure: Failure) -> None:
        """Count a genome that is left out after the search, and tell of it."""
        progress.count(failure)
        if self.on_left_out is not None:
            self.on_left_out(len(progress.history), failure)
