"""Regrowth: genomes of a search are grown again, which a foreign generator may fail to do; such a one is left out."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias, TypeVar

from treefit.confirm import UNSURE
from treefit.objective import Objective, reason_of
from treefit.plant import Genome
from treefit.progress import Failure

Found = TypeVar("Found")

Told: TypeAlias = Callable[[Failure], None]
"""Function that hears of what is left out."""

TRIES = 2
"""How often a plant is asked for, of a generator that may fail now and then."""

PATIENCE = 4
"""Genomes in a row that cannot be grown again, after which no other one is waited for."""

_log = logging.getLogger(__name__)


class UngrownError(RuntimeError):
    """A plant that was grown in the search could not be grown again; the message is the reason, its kind first."""


class SearchError(RuntimeError):
    """Nothing could be scored at all; the message says why."""


class GoneError(SearchError):
    """Trees were found, but none can be grown again; a generator that lives again may go on from the checkpoint."""


@dataclass
class Regrowth:
    """Makes what needs a plant of a genome of `objective`; what cannot be is left out and `told`, the rest goes on.

    In a `hurry`, as when the generator seems to be dead, nothing is tried twice.
    """

    objective: Objective
    told: Told | None = None
    hurry: bool = False
    first_reason: str = ""
    _in_a_row: int = 0

    @property
    def hopeless(self) -> bool:
        """Whether so many failed in a row that no other is tried."""
        return self._in_a_row >= PATIENCE

    def afresh(self) -> Regrowth:
        """Return this, with hope again."""
        self._in_a_row = 0
        return self

    def of(self, genome: Genome, make: Callable[[], Found]) -> Found | None:
        """What `make` makes of a plant of `genome` (n,); None, which is told, when it raises."""
        if self.hopeless:
            return None
        reason = ""
        for _ in range(1 if self.hurry else tries(self.objective)):
            try:
                found = make()
            except Exception as error:  # a foreign generator may raise anything, and must not end the run
                reason = str(error) if isinstance(error, UngrownError) else reason_of(error)
                if reason.startswith(UNSURE):
                    break
            else:
                self._in_a_row = 0
                return found
        self._leave_out(genome, reason)
        return None

    def _leave_out(self, genome: Genome, reason: str) -> None:
        self._in_a_row += not reason.startswith(UNSURE)  # one that answers need not be waited for
        self.first_reason = self.first_reason or reason
        _log.warning("a tree is left out, it could not be grown again: %s", reason)
        if self.told is not None:
            self.told(Failure(reason, self.objective.space.decode(genome), self.objective.seed))


def tries(objective: Objective) -> int:
    """How often a plant of `objective` is asked for: one that is sure to come out the same, once."""
    return 1 if objective.generator.pure else TRIES
