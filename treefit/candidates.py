"""Candidates: the few distinct trees that a search ends with, and how good each is beyond its own seed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial

import numpy as np

from treefit.confirm import UNSURE
from treefit.distinct import Distinct, Look, choose
from treefit.mask import Mask
from treefit.objective import Objective, Score
from treefit.plant import Genome, Plant, Value
from treefit.plant.extent import Extent, extent_of
from treefit.regrowth import GoneError, Regrowth, UngrownError, tries
from treefit.similarity.measures import Agreement, agreement, mean_agreement
from treefit.view.frame import Frame, sample

REPORT_HEIGHT = 256  # rows at which masks are compared in reports


@dataclass(frozen=True, eq=False)
class Candidate:
    """One tree: its genome (n,), values by name, seed, the plant with its mask at 256 rows, and how good it is.

    `score` is that of the search, the mean over `seeds` seeds; `agreement` is that of this plant, and the other two are
    the mean over the same values on other seeds, None when there were none.
    """

    genome: Genome
    values: Mapping[str, Value]
    seed: int
    seeds: int
    score: Score
    score_other_seeds: float | None
    agreement: Agreement
    agreement_other_seeds: Agreement | None
    plant: Plant
    extent: Extent
    mask: Mask


def judged(
    objective: Objective, ranked: Sequence[Look], count: int, wish: Distinct, target: Mask, other_seeds: int,
    regrowth: Regrowth,
) -> list[Candidate]:  # fmt: skip
    """At most `count` candidates of `ranked`, best first; others take the place of those that cannot be grown again.

    GoneError when none can be.
    """
    left, known = list(ranked), dict[Look, Candidate | None]()
    while left:
        chosen = choose(objective, left, count, wish)
        for look in chosen:
            if look not in known:
                known[look] = regrowth.of(look.genome, partial(_again, objective, look, target, other_seeds))
        found = [candidate for look in chosen if (candidate := known[look]) is not None]
        if len(found) == len(chosen) or (found and regrowth.hopeless):
            return found
        left = [] if regrowth.hopeless else [look for look in left if known.get(look, look) is not None]
    raise GoneError(f"none of the trees could be grown again; the first reason: {regrowth.first_reason}")


def _again(objective: Objective, look: Look, target: Mask, other_seeds: int) -> Candidate:
    found = judge(objective, look.genome, target, other_seeds)
    if found.score.failure is not None:
        raise UngrownError(found.score.failure)
    if found.score.total != look.score.total and not objective.generator.pure:
        raise UngrownError(f"{UNSURE}: its score was {look.score.total:.4f}, and grown again {found.score.total:.4f}")
    return found


def judge(objective: Objective, genome: Genome, target: Mask, other_seeds: int) -> Candidate:
    """Candidate of `genome`, compared with the mask `target` (h, w) and on `other_seeds` further seeds."""
    plant = objective.grow(genome, objective.seed)
    score = objective.score(plant) if len(objective.seeds) == 1 else objective.mean(genome)
    frame = objective.frame.finer(REPORT_HEIGHT)
    wanted, mask = sample(target, frame), objective.view(plant, frame).unpack()
    others = [_on(objective, genome, objective.seed + 1 + i, frame) for i in range(other_seeds)]
    return Candidate(
        genome=genome,
        values=objective.space.decode(genome),
        seed=objective.seed,
        seeds=len(objective.seeds),
        score=score,
        score_other_seeds=float(np.mean([score for score, _ in others])) if others else None,
        agreement=agreement(wanted, mask),
        agreement_other_seeds=mean_agreement([agreement(wanted, other) for _, other in others]),
        plant=plant,
        extent=extent_of(plant),
        mask=mask,
    )


def _on(objective: Objective, genome: Genome, seed: int, frame: Frame) -> tuple[float, Mask]:
    """Score and mask of `genome` on another seed; 0 and an empty mask where its plant cannot be scored."""
    for _ in range(tries(objective)):
        with suppress(Exception):  # a foreign generator may fail on this seed only, and must not end the run
            plant = objective.grow(genome, seed)
            score = objective.score(plant)
            if score.failure is None:
                return score.total, objective.view(plant, frame).unpack()
    return 0.0, np.zeros((frame.height, frame.width), np.uint8)
