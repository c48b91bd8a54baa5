"""Similarity: what the objective asks of a way to compare two masks."""

from __future__ import annotations

from typing import Protocol, TypeVar

from treefit.view.frame import BitMask

Description = TypeVar("Description")


class Similarity(Protocol[Description]):
    """Describes a mask once and compares two descriptions; both masks have the same frame."""

    def describe(self, bits: BitMask) -> Description:
        """What is compared of a mask."""

    def compare(self, target: Description, plant: Description) -> float:
        """Similarity in [0, 1]; exactly 1 for the same mask."""
