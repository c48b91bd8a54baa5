"""Mix: several similarities joined to one by their weights."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property
from typing import Any

from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.similarity.asymmetry import Asymmetry
from treefit.similarity.class_overlap import ClassOverlap
from treefit.similarity.paper import PaperSimilarity
from treefit.similarity.similarity import Similarity
from treefit.similarity.soft_classes import SoftClasses
from treefit.similarity.texture import Texture
from treefit.similarity.trunk import Trunk
from treefit.view.frame import BitMask

WEIGHTS = {"soft": 0.3, "stripes": 0.15, "classes": 0.25, "texture": 0.2, "trunk": 0.07, "asymmetry": 0.03}
"""Weights of the default terms: those that gave the best fits (experiments/similarities.md)."""


def _terms() -> dict[str, Similarity[Any]]:
    return {
        "soft": SoftClasses(), "stripes": PaperSimilarity(), "classes": ClassOverlap(), "texture": Texture(),
        "trunk": Trunk(), "asymmetry": Asymmetry(),
    }  # fmt: skip


@dataclass(frozen=True, config=ConfigDict(extra="forbid", arbitrary_types_allowed=True))
class Mix:
    """Joins `terms` by `weights`, names as keys: sum w s / sum w, or with `combine` product: (prod s^w)^(1 / sum w).

    A term of weight 0 costs nothing. ValueError for a weight without its term, a term without its weight, weights
    under 0 or all 0.
    """

    terms: Mapping[str, Any] = Field(default_factory=_terms)
    weights: Mapping[str, float] = Field(default_factory=lambda: dict(WEIGHTS))
    combine: str = Field(default="sum", pattern="^(sum|product)$")

    def __post_init__(self) -> None:
        if self.terms.keys() != self.weights.keys():
            odd = ", ".join(sorted(self.terms.keys() ^ self.weights.keys()))
            raise ValueError(f"similarity: terms and weights must have the same names, {odd} is in one of them only")
        if min(self.weights.values(), default=0.0) < 0 or sum(self.weights.values()) <= 0:
            raise ValueError(f"similarity: weights must not be negative and not all 0, got {dict(self.weights)}")

    @cached_property
    def used(self) -> list[tuple[Similarity[Any], float]]:
        """Terms that count, with their share of all weights."""
        whole = sum(self.weights.values())
        return [(self.terms[name], weight / whole) for name, weight in self.weights.items() if weight > 0]

    def describe(self, bits: BitMask) -> list[Any]:
        """Descriptions of the terms that count, in order."""
        return [term.describe(bits) for term, _ in self.used]

    def compare(self, target: list[Any], plant: list[Any]) -> float:
        """Joined similarity in [0, 1], exactly 1 for the same mask."""
        found = [(term.compare(a, b), share) for (term, share), a, b in zip(self.used, target, plant, strict=True)]
        if self.combine == "product":
            return float(math.prod(similarity**share for similarity, share in found))
        return float(max(1.0 - sum((1.0 - similarity) * share for similarity, share in found), 0.0))
