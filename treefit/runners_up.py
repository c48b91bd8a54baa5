"""Runners-up: after the search, one of its own for each further candidate, which begins at other trees.

Those are children of the best and of genomes that the picture suggests: what the best has learnt of the outline is
kept in some, with the branching, the leaves or the trunk of another tree.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from treefit.apart import Apart
from treefit.confirm import trusted
from treefit.distinct import Distinct, Look, looks
from treefit.evaluation import Evaluator
from treefit.objective import Objective, Score
from treefit.plant import Genome
from treefit.racing import Seeds
from treefit.regrowth import Regrowth
from treefit.search import CMAES, Hints
from treefit.search.hints import Genomes
from treefit.search.operators import one_dot_crossover
from treefit.watch import Watch

MOST = 2500
"""Genomes of such a search at most, however many the main one has: by then it is within a few percent of its end."""

ENOUGH = 1000
"""Genomes under which it looks half as far from the beginning: what is far away takes more to become good."""

POPULATION, STEP, LAST_STEP = 16, 0.1, 0.03
"""Draws of a generation, and their standard deviation in the first, of every gene, in either part of a search."""

LAST = 0.3
"""Share of a search that is kept: to refine what was found, or, when it is too bad, to find something nearer."""

STRANGERS = 0.1
"""Share of either part that children of other trees are tried with; the best of them is where it begins."""

Told: TypeAlias = Callable[[NDArray[np.float64], list[Score], int], None]
"""Function that hears of genomes (m, n), their scores and how many plants these took."""


@dataclass(frozen=True, eq=False)
class RunnersUp:
    """Search for trees that differ from the best of `objective` as `wish` says, and are nearly as good."""

    objective: Objective
    wish: Distinct
    hints: Hints
    evaluator: Evaluator
    seeds: Seeds
    watch: Watch
    regrowth: Regrowth

    def added(self, ranked: Sequence[Look], count: int, plants: int, told: Callable[[str], Told]) -> list[Look]:
        """Return `ranked`, best first, with what `plants` plants lead to when `count` candidates are wanted.

        `told`, given the name of the stage, returns who hears of its batches.
        """
        chosen, known = [ranked[0]], list(ranked)
        for i in range(1, count):
            share = plants // (count - i)
            plants -= share
            rng = np.random.default_rng([self.objective.seed, i])
            chosen.append(self._next(chosen, known, share, rng, told(f"candidate {i + 1}")))
        return sorted(known, key=lambda look: -look.score.total)

    def _next(
        self, chosen: Sequence[Look], known: list[Look], plants: int, rng: np.random.Generator, told: Told
    ) -> Look:
        """Best that is apart from `chosen`; whatever is found on the way joins `known`."""
        halved, last = int(plants < ENOUGH * self.seeds.plants), round(LAST * plants)
        best = max(known, key=lambda look: look.score.total)  # a runner-up may have become better than the first
        for refines, share in ((False, plants - last), (True, last)):
            apart, reach = Apart.of(self.objective, chosen, self.wish.relaxed()[halved]), 0.5**halved
            starts = strangers(best.genome, self.hints, round(STRANGERS * share / self.seeds.plants), reach, rng)
            if refines:
                starts = np.concatenate([max(known, key=apart.of_look).genome[None], starts])
            step = LAST_STEP if refines else STEP * reach
            found = looks(self.objective, self._search(apart, starts, step, share, rng, told), self.regrowth)
            known += found
            if not any(look.score.total >= (1 - self.wish.within) * best.score.total for look in found):
                halved += 1  # half as far is better than nothing
        return max(known, key=apart.of_look)

    def _search(
        self, apart: Apart, starts: Genomes, step: float, plants: int, rng: np.random.Generator, told: Told
    ) -> Genomes:
        """Best genome (1, n) that `plants` plants find from the best of `starts` (m, n); (0, n) when too few."""
        odd = 2 * (self.seeds.count - 1)  # plants more for the first and last batch, too small to race as a large one
        evaluations = int((plants - odd) / self.seeds.plants)
        if evaluations < 1 or len(starts) == 0 or self.watch.dead:
            return starts[:0]
        settings = CMAES(evaluations=evaluations, start="presets", start_share=1, start_most=len(starts),
                         known_step=step, min_population=POPULATION, max_population=POPULATION, growth=1)  # fmt: skip
        n = len(apart.space)
        search = settings.begin(n, int(rng.integers(2**31)), replace(Hints.none(n), known=starts))
        with trusted(self.evaluator, apart, self.seeds, self.watch) as race:
            while not search.done and not self.watch.dead:
                asked = search.ask()
                scores, grown = race(asked, search.floors())
                search.tell(np.array([score.total for score in scores]))
                told(asked, scores, grown)
        return search.best(1)[0]


def strangers(best: Genome, hints: Hints, count: int, reach: float, rng: np.random.Generator) -> Genomes:
    """Children (count, n) of `best` and of genomes of `hints`, uniform ones where these are too few.

    They go a share `reach` of the way from the best to such a child, every other one half of that.
    """
    other = rng.permutation(np.concatenate([hints.known, hints.guess]))[:count]
    other = np.concatenate([other, rng.random((count - len(other), len(best)))])
    children = one_dot_crossover(np.repeat(best[None], count, axis=0), other, rng)
    share = np.where(np.arange(count) % 2, reach / 2, reach)[:, None]
    return np.asarray(best + share * (children - best))
