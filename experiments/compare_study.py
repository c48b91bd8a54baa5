"""Study: all that the task compare has so far, in groups, and its numbers for other programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite

import numpy as np

from experiments.compare_runs import Run
from experiments.compare_settings import Compare
from experiments.compare_statistics import Group, differences, means, quartiles

ALL = "all generators"
"""Name of the group of all runs together."""


@dataclass(frozen=True, eq=False)
class Study:
    """Runs so far of `planned`; optimisers by name with their settings in words."""

    wanted: Compare
    recipes: Mapping[str, str]
    versions: Mapping[str, str]
    seed: int
    other_seeds: int
    planned: int
    runs: Sequence[Run]

    @property
    def groups(self) -> list[Group]:
        """One group a generator that has runs to compare."""
        found = [self._group(name, [run for run in self.runs if run.label.generator == name])
                 for name in self.wanted.generators]  # fmt: skip
        return [group for group in found if group.places]

    @property
    def whole(self) -> Group | None:
        """All generators together, each with its own targets; None when there is one only."""
        if len(self.groups) < 2:
            return None
        labels = [replace(run.label, target=f"{run.label.generator}/{run.label.target}") for run in self.runs]
        runs = [replace(run, label=label) for run, label in zip(self.runs, labels, strict=True)]
        group = Group.of(
            ALL, self.wanted.optimizers, [run for run in runs if run.label.optimizer in self.wanted.optimizers]
        )
        return group if group.places else None

    def _group(self, name: str, runs: Sequence[Run]) -> Group:
        return Group.of(name, self.wanted.optimizers_on(name), runs)


def numbers(group: Group, wanted: Compare) -> dict[str, dict[str, object]]:
    """Numbers of each optimiser, for JSON; what is not known is None."""
    end = wanted.evaluations
    reference = group.stronger(wanted.reference, end)
    by_budget = {budget: (means(group.at(budget)), differences(group.at(budget))) for budget in wanted.columns}
    others = differences(group.on_other_seeds), means(group.on_other_seeds)
    found: dict[str, dict[str, object]] = {}
    for i, name in enumerate(group.optimizers):
        reach = quartiles(group.reach(name, reference, end)) if reference else None
        found[name] = {
            "score": {budget: _plain(mean[0][i], mean[1][i]) for budget, (mean, _) in by_budget.items()},
            "to_first": {budget: _plain(apart[0][i], apart[1][i]) for budget, (_, apart) in by_budget.items()},
            "other_seeds": _plain(others[1][0][i], others[1][1][i]),
            "other_seeds_to_first": _plain(others[0][0][i], others[0][1][i]),
            "reach_quartiles": _plain(*reach) if reach else None,
            "own_time": own_time(group.of_optimizer(name)),
            "seconds": float(np.mean([run.seconds for run in group.of_optimizer(name)])),
        }
    return found


def own_time(runs: Sequence[Run]) -> float:
    """Share of the processor time of `runs` that the optimiser took itself."""
    return sum(run.own_seconds for run in runs) / max(sum(run.seconds for run in runs), 1e-9)


def _plain(*values: float) -> list[float | None]:
    return [float(value) if isfinite(value) else None for value in values]
