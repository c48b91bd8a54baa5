"""Group: the runs of the task compare on one generator, and what their scores say of the optimisers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import inf, nan

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from experiments.compare_runs import Run

Table = NDArray[np.float64]
"""Numbers (o, t), a row an optimiser, a column a target, repeats averaged."""

Column = NDArray[np.float64]  # (o,), an optimiser each


@dataclass(frozen=True, eq=False)
class Group:
    """Runs by optimiser and place (target and repeat); of every optimiser the same `places`."""

    name: str
    optimizers: tuple[str, ...]
    places: tuple[tuple[str, int], ...]
    runs: dict[tuple[str, str, int], Run]

    @classmethod
    def of(cls, name: str, optimizers: Iterable[str], runs: Iterable[Run]) -> Group:
        """Return the group of `runs` at the places that all `optimizers` have, but for those without any run."""
        known = {(run.label.optimizer, run.label.target, run.label.repeat): run for run in runs}
        begun = tuple(one for one in optimizers if any(one == optimizer for optimizer, _, _ in known))
        places = dict.fromkeys((target, repeat) for _, target, repeat in known)
        whole = tuple(place for place in places if all((one, *place) in known for one in begun))
        return cls(name, begun, whole, known)

    @property
    def targets(self) -> list[str]:
        """Names of the targets."""
        return list(dict.fromkeys(target for target, _ in self.places))

    def of_optimizer(self, optimizer: str) -> list[Run]:
        """Runs of an optimiser, place by place."""
        return [self.runs[optimizer, *place] for place in self.places]

    def at(self, evaluations: float) -> Table:
        """Scores after so many evaluations."""
        return self._table([[run.at(evaluations) for run in self.of_optimizer(one)] for one in self.optimizers])

    @property
    def on_other_seeds(self) -> Table:
        """Scores of what was found on other seeds, nan where there were none."""
        return self._table([[nan if run.score_other_seeds is None else run.score_other_seeds
                             for run in self.of_optimizer(one)] for one in self.optimizers])  # fmt: skip

    def stronger(self, names: Sequence[str], evaluations: int) -> str | None:
        """Of `names` the optimiser with the best mean after so many evaluations, None when none of them was run."""
        means = dict(zip(self.optimizers, self.at(evaluations).mean(axis=1), strict=True))
        return max((name for name in names if name in means), key=means.__getitem__, default=None)

    def reach(self, optimizer: str, reference: str, evaluations: int) -> list[float]:
        """Evaluations, place by place, after which an optimiser has the score that `reference` has at the end."""
        pairs = zip(self.of_optimizer(optimizer), self.of_optimizer(reference), strict=True)
        return [run.reaches(goal.at(evaluations)) for run, goal in pairs]

    def _table(self, scores: list[list[float]]) -> Table:
        of_place = np.array([target for target, _ in self.places])
        whole = np.array(scores, float)
        return np.column_stack([whole[:, of_place == target].mean(axis=1) for target in self.targets])


def means(scores: Table) -> tuple[Column, Column]:
    """Means over targets and their standard errors, which are mostly how unlike the targets are."""
    return scores.mean(axis=1), _error(scores)


def differences(scores: Table) -> tuple[Column, Column]:
    """Means over targets of the differences to the first optimiser, and their standard errors.

    They are paired, target by target: how hard a target is, and how other optimisers scatter, does not count.
    """
    apart = scores - scores[0]
    return apart.mean(axis=1), _error(apart)


def signed_rank(scores: Table) -> Column:
    """P values of Wilcoxon's signed-rank test of the first optimiser against each over the targets; nan for itself."""
    apart = scores[0] - scores
    found = [
        nan if i == 0 else 1.0 if not row.any() else float(stats.wilcoxon(row).pvalue) for i, row in enumerate(apart)
    ]
    return np.array(found)


def ranks(scores: Table) -> Column:
    """Mean ranks over the targets, 1 for the best."""
    return np.asarray(stats.rankdata(-scores, axis=0).mean(axis=1))


def friedman(scores: Table) -> float:
    """P value of Friedman's test that all optimisers are alike; nan for fewer than three of them, or two targets."""
    return float(stats.friedmanchisquare(*scores).pvalue) if len(scores) > 2 and scores.shape[1] > 1 else nan


def quartiles(counts: Sequence[float]) -> tuple[float, float, float]:
    """Lower quartile, median and upper quartile of counts that may be inf; nothing is between a number and inf."""
    ordered = sorted(counts)

    def at(share: float) -> float:
        place = share * (len(ordered) - 1)
        low, high = ordered[int(place)], ordered[int(np.ceil(place))]
        return high if inf in (low, high) else low + (high - low) * (place % 1)

    return at(0.25), at(0.5), at(0.75)


def _error(scores: Table) -> Column:
    count = scores.shape[1]
    return scores.std(axis=1, ddof=1) / np.sqrt(count) if count > 1 else np.full(len(scores), nan)
