"""A search whose whole state are the scores that it was told: a restored one is told them again, with the same seed.

For methods that are written as a plain loop, or come from other packages. Such a loop is a Python generator: it yields
genomes and is sent their scores.
"""

from __future__ import annotations

from collections.abc import Callable, Generator

import numpy as np
from numpy.typing import NDArray

from treefit.search.archive import Archive
from treefit.search.optimizer import Genomes, Scores, State

Moves = Generator[Genomes, Scores, None]
"""Yields genomes (m, n), is sent their scores (m,), and never ends."""


class Replay:
    """Optimizer that makes the `moves`; every score matters, so there are no floors."""

    def __init__(self, stage: str, moves: Callable[[], Moves], n_genes: int, evaluations: int) -> None:
        self.stage, self.evaluations, self.n_genes = stage, evaluations, n_genes
        self._begin_moves = moves
        self._scores: Scores | None = None
        self._asked: Genomes | None = None
        self._reset()

    @property
    def done(self) -> bool:
        """Whether the budget of evaluations is spent."""
        return self.told >= self.evaluations

    def ask(self) -> Genomes:
        """The next genomes of the moves; the last ones are cut to the budget."""
        if self._asked is not None:
            raise ValueError("ask: tell the scores of the last genomes first")
        asked = next(self._moves) if self._scores is None else self._moves.send(self._scores)
        self._asked = np.clip(asked, 0.0, 1.0)[: self.evaluations - self.told]
        return self._asked

    def floors(self) -> Scores:
        """No floors."""
        if self._asked is None:
            raise ValueError("floors: ask for genomes first")
        return np.full(len(self._asked), -np.inf)

    def tell(self, scores: Scores) -> None:
        """Take the scores."""
        if self._asked is None or len(scores) != len(self._asked):
            raise ValueError(f"tell: needs one score for each genome asked, got {len(scores)}")
        self._scores = np.array(scores, float)
        self._all[self.told : self.told + len(scores)] = self._scores
        self.archive.add(self._asked, self._scores)
        self.told += len(scores)
        self._asked = None

    def best(self, count: int) -> tuple[Genomes, Scores]:
        """Distinct best of the whole run."""
        return self.archive.best(count)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """All scores told so far (m,), in order."""
        return {"scores": self._all[: self.told].copy()}

    def restore(self, state: State) -> None:
        """Begin again and be told the scores of `state`."""
        scores = np.asarray(state["scores"], float)
        self._reset()
        while self.told < len(scores):
            self.tell(scores[self.told : self.told + len(self.ask())])

    def _reset(self) -> None:
        self._moves = self._begin_moves()
        self.archive, self.told = Archive(self.n_genes), 0
        self._all = np.empty(self.evaluations)
        self._scores = self._asked = None
