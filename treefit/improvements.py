"""Improvements: the plants that a search held to be its best, one after another, so that its story can be told."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

SPANS = 4
"""Spans of evaluations in a doubling of them; of each, the last improvement alone is kept."""


@dataclass(frozen=True)
class Improvement:
    """A plant better than all before it: its genome, its score, and the evaluations after which it was known."""

    evaluations: int
    score: float
    image: float  # image similarity, the score without the wishes
    genome: tuple[float, ...]

    @classmethod
    def from_json(cls, kept: Mapping[str, Any]) -> Improvement:
        """Improvement from what `dataclasses.asdict` made of one and JSON gave back."""
        return cls(kept["evaluations"], kept["score"], kept["image"], tuple(kept["genome"]))

    @property
    def span(self) -> int:
        """Span of evaluations that it falls into."""
        return math.floor(SPANS * math.log2(max(self.evaluations, 1)))


def joined(known: Sequence[Improvement], new: Improvement) -> list[Improvement]:
    """Return `known` with `new` at its end, in place of the last one when both fall into one span.

    So there are never more than SPANS for each doubling of the evaluations: 63 after 50,000 of them.
    """
    kept = known[:-1] if known and known[-1].span == new.span else known
    return [*kept, new]
