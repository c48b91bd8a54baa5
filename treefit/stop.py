"""Stop: when a search ends before its budget is spent."""

from __future__ import annotations

from dataclasses import dataclass

from treefit.progress import Progress


@dataclass(frozen=True)
class Stop:
    """When to end before the budget is spent: at a score, after seconds, or after so many plants; None for never."""

    score: float | None = None
    seconds: float | None = None
    plants: int | None = None

    def earlier(self, share: float, plants: int) -> Stop:
        """Return the same for the search, a `share` of the time and of all `plants` being for what comes after it."""
        seconds = None if self.seconds is None else (1 - share) * self.seconds
        return Stop(self.score, seconds, round((1 - share) * plants))

    def reached(self, progress: Progress) -> bool:
        """Whether it is time to end."""
        if not progress.history:
            return False
        now = progress.history[-1]
        return (
            (self.score is not None and now.best >= self.score)
            or (self.seconds is not None and now.seconds >= self.seconds)
            or (self.plants is not None and now.evaluations >= self.plants)
        )
