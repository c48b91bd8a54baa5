"""Racing: genomes are scored on several seeds, and those that fall behind on fewer of them.

Successive halving within a batch: all genomes on one seed, the better half on half of the seeds, the best quarter on
all. A genome that stops early is told its mean so far, but less than the worst of those that went further: the order of
the scores is the order of promise.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, fields, replace
from itertools import pairwise
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from treefit.evaluation import Batch, Evaluator
from treefit.objective import Objective, Score, mean_score
from treefit.plant import Genome

FURTHER_SEEDS = 1001
"""From the seed of the search to the further ones of a score: `other_seeds`, the test of a candidate, end before."""

Race: TypeAlias = Callable[[NDArray[np.float64], NDArray[np.float64]], tuple[list[Score], int]]
"""Function on genomes (m, n) and floors (m,) to m scores, and the count of plants that were grown for them."""


@dataclass(frozen=True)
class Seeds:
    """How many seeds a score is the mean of, and whether genomes race for them; all are scored on all if not."""

    count: int = 1
    racing: bool = True

    def further(self, seed: int) -> tuple[int, ...]:
        """Seeds besides that of the search."""
        return tuple(range(seed + FURTHER_SEEDS, seed + FURTHER_SEEDS + self.count - 1))

    @property
    def rounds(self) -> list[tuple[int, int]]:
        """Of each round, the part of a batch that is in it, as divisor, and on how many seeds it is scored by then."""
        if not self.racing:
            return [(1, self.count)]
        reached = [(1, 1), (2, (self.count + 1) // 2), (4, self.count)]
        return [reached[0], *(now for before, now in pairwise(reached) if now[1] > before[1])]

    @property
    def plants(self) -> float:
        """Plants a genome, as mean over a large batch."""
        reached = [0, *(seeds for _, seeds in self.rounds)]
        return sum((seeds - before) / part for (part, seeds), before in zip(self.rounds, reached, strict=False))


@contextmanager
def raced(
    evaluator: Evaluator, objective: Objective, seeds: Seeds, around: Callable[[Batch], Batch] = lambda batch: batch
) -> Iterator[Race]:
    """Keep the workers of `evaluator` for the many batches of a search; with one seed, its batches are left alone.

    `around` makes, of the function that scores a batch, another one.
    """
    if seeds.count == 1:
        with evaluator.started(objective) as started:
            batch = around(started)
            yield lambda genomes, floors: (batch(genomes, floors), len(genomes))
    else:
        with evaluator.started(_OnSeeds.of(objective)) as started:
            batch = around(started)
            yield lambda genomes, _: race(batch, genomes, objective.seeds, seeds.rounds)


def race(
    batch: Batch, genomes: NDArray[np.float64], seeds: Sequence[int], rounds: Sequence[tuple[int, int]]
) -> tuple[list[Score], int]:
    """Scores to tell of `genomes` (m, n), means over `seeds`, and the count of plants.

    `batch` takes rows (any, n + 1): a genome and the place of its seed. Floors are of no use here: one plant alone
    shows of hardly any genome that its mean is under them.
    """
    found: list[list[Score]] = [[] for _ in genomes]
    running, groups = np.arange(len(genomes)), []
    for part, reach in rounds:
        kept = max(1, len(genomes) // part)
        if kept < len(running):
            order = running[np.argsort([-_total(found[i]) for i in running], kind="stable")]
            running = np.sort(order[:kept])
            groups.append(order[kept:])
        places = [(int(i), j) for i in running for j in range(len(found[i]), reach)]
        rows = np.array([[*genomes[i], j] for i, j in places])
        for (i, _), score in zip(places, batch(rows, np.full(len(rows), -np.inf)), strict=True):
            found[i].append(score)
    groups.append(running)
    told = [mean_score(scores, seeds) for scores in found]
    for group, better in reversed([*pairwise(groups)]):
        _keep_under(told, group, min(told[i].total for i in better))
    return told, sum(map(len, found))


def _total(scores: Sequence[Score]) -> float:
    return sum(score.total for score in scores) / len(scores)


def _keep_under(told: list[Score], group: NDArray[np.intp], ceiling: float) -> None:
    """Lower the totals of a group that stopped early, all by as much, till its best is under the `ceiling`."""
    over = max(told[i].total for i in group) - float(np.nextafter(ceiling, -1))
    if over > 0:
        for i in group:
            told[i] = replace(told[i], total=max(0.0, told[i].total - over))


@dataclass(frozen=True, eq=False, kw_only=True)
class _OnSeeds(Objective):
    """The objective `whole` on rows (n + 1,), a genome and the place of its seed: so one batch has several seeds."""

    whole: Objective

    @classmethod
    def of(cls, whole: Objective) -> _OnSeeds:
        return cls(**{one.name: getattr(whole, one.name) for one in fields(Objective)}, whole=whole)

    def __call__(self, genome: Genome, floor: float = -np.inf) -> Score:
        return self.whole.on(self.seeds[int(genome[-1])])(genome[:-1], floor)
