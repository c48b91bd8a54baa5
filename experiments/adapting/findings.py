"""Findings of the task adapt: all that it has learnt of a foreign generator, as its files and its report tell it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from experiments.adapting.effects import Effect
from experiments.adapting.ends import Ends, reasons
from experiments.adapting.ranges import Proposal
from experiments.adapting.rounds import Round
from experiments.adapting.space import SIZE, entry
from experiments.adapting.trial import Tree, Trial


@dataclass(frozen=True, eq=False)
class Findings:
    """What the trials of a generator have shown; `source` is where the example is from."""

    generator: str
    version: str
    source: str
    notes: Sequence[str]
    proposals: Sequence[Proposal]
    example: Tree
    trial: Trial
    before: Sequence[Round]  # wider spaces, of which too few trees grew
    effects: Mapping[str, Effect]
    ends: Mapping[str, Ends]
    repeated: tuple[int, int]  # calls that gave the same tree again, of how many

    @property
    def searched(self) -> list[Proposal]:
        """Proposals that are searched, those that change most first."""
        free = [one for one in self.proposals if one.searched]
        return sorted(free, key=lambda one: -self.effects[one.name].mean if one.name in self.effects else 0.0)

    @property
    def fixed(self) -> list[Proposal]:
        """Those that are not, but for seeds."""
        return [one for one in self.proposals if not one.searched and not one.left_out]

    @property
    def size_parameter(self) -> str | None:
        """First of those that scale the whole tree."""
        return size_parameter(self.proposals)

    @property
    def seconds(self) -> dict[str, float]:
        """How long a call takes."""
        return _spread([tree.seconds for tree in self.trial.trees])

    @property
    def vertices(self) -> dict[str, float]:
        """Vertices of the trees that grew."""
        return _spread([tree.vertices for tree in self.trial.good])

    @property
    def leaves(self) -> dict[str, float]:
        """Leaves of them."""
        return _spread([tree.leaves for tree in self.trial.good])


def size_parameter(proposals: Sequence[Proposal]) -> str | None:
    """Name of the first proposal that scales the whole tree, None when none does."""
    return next((one.name for one in proposals if one.reason == SIZE), None)


def as_facts(found: Findings) -> dict[str, object]:
    """All of it as plain numbers and texts."""
    return {
        "generator": found.generator, "version": found.version, "example": found.source, "notes": list(found.notes),
        "example_grew": found.example.grew, "trees": len(found.trial.trees), "grew": len(found.trial.good),
        "failures": _failures(reasons(found.trial)),
        "before": [{"share": one.share, "failures": _failures(one.failures), "narrowed": list(one.narrowed)}
                   for one in found.before],
        "seconds": found.seconds, "vertices": found.vertices, "leaves": found.leaves,
        "same_again": list(found.repeated), "size_parameter": found.size_parameter,
        "parameters": [_parameter(found, one) for one in found.proposals],
    }  # fmt: skip


def _failures(told: Sequence[tuple[int, str, str]]) -> list[dict[str, object]]:
    return [{"count": count, "kind": kind, "first": first} for count, kind, first in told]


def _parameter(found: Findings, one: Proposal) -> dict[str, object]:
    effect, ends = found.effects.get(one.name), found.ends.get(one.name)
    return {
        "name": one.name, "example": one.value, "searched": one.searched, "reason": one.reason,
        "range": entry(one.parameter) if one.parameter else None,
        "changes": {"mean": effect.mean, "most": effect.most} if effect and effect.tried else None,
        "fails": {"low": ends.low, "high": ends.high, "at_fault": ends.at_fault} if ends else None,
    }  # fmt: skip


def _spread(numbers: Sequence[float]) -> dict[str, float]:
    if not numbers:
        return {}
    return {"median": float(np.median(numbers)), "p95": float(np.quantile(numbers, 0.95)), "max": float(max(numbers))}
