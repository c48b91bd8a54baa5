"""Optimizer: ask for genomes, tell their scores; knows nothing of trees, pictures or files."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from treefit.search.hints import Genomes, Hints

__all__ = ["Genomes", "Optimizer", "Scores", "State", "Strategy"]

Scores = NDArray[np.float64]  # (m,)
State = Mapping[str, NDArray[np.generic]]


class Optimizer(Protocol):
    """A search under way. `stage` says in a word or two where it is."""

    @property
    def done(self) -> bool:
        """Whether the budget of evaluations is spent."""

    @property
    def stage(self) -> str:
        """Where the search is, for the progress bar."""

    def ask(self) -> Genomes:
        """Genomes (m, n) to score; ValueError when the last ones were not told yet."""

    def floors(self) -> Scores:
        """Scores (m,), one for each genome asked last: whatever is told at or under it, the search goes on the same.

        Minus infinity where every score matters.
        """

    def tell(self, scores: Scores) -> None:
        """Take the scores (m,) of the genomes asked last, higher is better."""

    def best(self, count: int) -> tuple[Genomes, Scores]:
        """At most `count` distinct genomes and their scores, best first."""

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Everything needed to go on, as plain arrays; only between tell and ask."""

    def restore(self, state: State) -> None:
        """Go on from `state`."""


class Strategy(Protocol):
    """Settings of a way to search; `begin` makes an Optimizer."""

    @property
    def evaluations(self) -> int:
        """Budget: count of genomes that are scored."""

    def begin(self, n_genes: int, seed: int, hints: Hints | None = None) -> Optimizer:
        """Optimizer for genomes of `n_genes` genes; all its draws come from `seed`.

        `hints` may lead it, or not; a restored one needs the same as the one that it goes on from.
        """
