"""Confirmed: a new best score of a foreign generator is believed when its plant, grown again, has the same one."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from treefit.evaluation import Evaluator
from treefit.objective import UNGROWN, Objective, Score
from treefit.plant import Genome
from treefit.racing import Race, Seeds, raced
from treefit.watch import Watch

UNSURE = "NotDeterministic"
"""Kind of the failure of a plant that is another one when it is grown again."""


@contextmanager
def trusted(
    evaluator: Evaluator, objective: Objective, seeds: Seeds, watch: Watch, known: float = 0.0
) -> Iterator[Race]:
    """Keep workers as `raced` does; what a generator that is not pure gives is watched, and over `known` confirmed."""
    with raced(evaluator, objective, seeds, watch.over) as race:
        yield race if objective.generator.pure else confirmed(race, known, seeds.rounds[-1][0], watch)


def confirmed(race: Race, known: float, part: int, watch: Watch) -> Race:
    """Return `race` in which no score over all before, `known` at first, is told that a second growth denies.

    The best of a batch, one of `part` genomes, were grown on all seeds: when none of them holds, the others are not
    told to be better than what is known. Second growths are not counted as plants.
    """

    def twice(genomes: NDArray[np.float64], floors: NDArray[np.float64]) -> tuple[list[Score], int]:
        nonlocal known
        before = watch.skipped
        scores, plants = race(genomes, floors)
        plants -= watch.skipped - before
        order = sorted(range(len(scores)), key=lambda i: -scores[i].total)
        for place, i in enumerate(order):
            if scores[i].total <= known:
                break
            if place >= max(1, len(genomes) // part):
                scores[i] = replace(scores[i], total=known)
                continue
            doubt = _doubt(race, genomes[i], scores[i])
            if doubt is None:
                known = scores[i].total
                break
            scores[i] = Score(0.0, failure=doubt)
        return scores, plants

    return twice


def _doubt(race: Race, genome: Genome, first: Score) -> str | None:
    """Why `first` is not to be believed, None when it is; a generator that now fails is asked once more."""
    reason = ""
    for _ in range(2):
        (score,), _ = race(genome[None], np.full(1, -np.inf))
        if score.failure is None:
            same = score.total == first.total
            return None if same else f"{UNSURE}: its score was {first.total:.4f}, and grown again {score.total:.4f}"
        reason = score.failure
        if reason.startswith((UNSURE, UNGROWN)):
            return reason
    return f"{UNSURE}: grown again, it failed: {reason}"
