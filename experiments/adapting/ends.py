"""Ends of ranges at which trees fail: shares of failures where a parameter is low, and where it is high."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import fisher_exact

from experiments.adapting.trial import Trial
from treefit.plant import Parameter

CONSPICUOUS = 0.2
"""Difference of the two shares from which on an end is at fault,"""

UNLIKELY = 1e-3
"""and how seldom chance alone makes it."""


@dataclass(frozen=True)
class Ends:
    """Shares of trees that fail where a parameter is low and where it is high; `at_fault`: "low", "high" or ""."""

    low: float
    high: float
    at_fault: str = ""


def failing_ends(trial: Trial) -> dict[str, Ends]:
    """Ends of each gene of `trial` by name: its lowest and highest third, the two values of a bool; no choices."""
    failed = np.array([not tree.grew for tree in trial.trees])
    return {parameter.name: _ends(parameter, trial.genomes[:, i], failed)
            for i, parameter in enumerate(trial.space.free) if parameter.kind != "choice"}  # fmt: skip


def reasons(trial: Trial) -> list[tuple[int, str, str]]:
    """Counts of failures by kind, most first, each with the kind and the first of its reasons."""
    bad = [tree for tree in trial.trees if not tree.grew]
    first = {tree.kind: tree.reason for tree in reversed(bad)}
    return [(count, kind, first[kind]) for kind, count in Counter(tree.kind for tree in bad).most_common()]


def _ends(parameter: Parameter, genes: NDArray[np.float64], failed: NDArray[np.bool_]) -> Ends:
    part = 1 / 2 if parameter.kind == "bool" else 1 / 3
    sides = [failed[genes < part], failed[genes >= 1 - part]]
    low, high = (float(side.mean()) if len(side) else 0.0 for side in sides)
    if abs(high - low) < CONSPICUOUS:
        return Ends(low, high)
    chance = float(fisher_exact([[side.sum(), len(side) - side.sum()] for side in sides]).pvalue)
    return Ends(low, high, ("high" if high > low else "low") if chance < UNLIKELY else "")
