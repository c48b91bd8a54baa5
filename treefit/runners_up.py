"""Runners-up: after the search, a short one for each further candidate, of genomes that are different from the best."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from treefit.distinct import Distinct, Look, genome_distance, looks
from treefit.evaluation import Evaluator
from treefit.objective import Objective, Score
from treefit.plant import Genome, Plant
from treefit.racing import Race, Seeds, raced
from treefit.search.gaussian import around, learn, rates
from treefit.search.operators import mirrored

POPULATION, STEP = 12, 0.03
"""Draws of a generation, and their standard deviation in the first, of every gene."""

MOST = 500
"""Genomes of such a search at most, however many the main one has: it is to be near by."""

FARTHER = 1.1
"""By how much farther than wished from the best such a search begins."""

MARGIN = 1.02
"""How much farther than wished a runner-up is looked for: rounding must not make it too near."""

Told: TypeAlias = Callable[[NDArray[np.float64], list[Score], int], None]
"""Function that hears of genomes (m, n), their scores and how many plants these took."""


def with_runners_up(
    objective: Objective, ranked: Sequence[Look], count: int, wish: Distinct, plants: int, evaluator: Evaluator,
    seeds: Seeds, told: Callable[[str], Told],
) -> list[Look]:  # fmt: skip
    """Return `ranked` with a runner-up more for each further candidate, found with `plants` plants in all; best first.

    `told`, given the name of the stage, returns who hears of its batches.
    """
    chosen, known = [ranked[0]], list(ranked)
    for i in range(1, count):
        share = plants // (count - i)
        if share == 0:
            continue
        plants -= share
        rule = wish
        for leg, part in enumerate((share // 2, share - share // 2)):
            if part:
                apart = Apart.of(objective, chosen, rule)
                with raced(evaluator, apart, seeds) as race:
                    genome = runner_up(apart, known, race, part, seeds, (i, leg), told(f"candidate {i + 1}"))
                found = looks(objective, [genome])
                known += found
                if not found or found[0].score.total < (1 - wish.within) * ranked[0].score.total:
                    rule = wish.relaxed()[1]  # too good to be far away: half as far is better than nothing
        chosen = chosen + found
    return sorted(known, key=lambda look: -look.score.total)


@dataclass(frozen=True, eq=False, kw_only=True)
class Apart(Objective):
    """The objective, lowered where a plant or a genome is nearer to one of `chosen` than `wish` allows."""

    chosen: Sequence[Look]
    wish: Distinct

    @classmethod
    def of(cls, objective: Objective, chosen: Sequence[Look], wish: Distinct) -> Apart:
        """Return `objective`, apart from what is `chosen`."""
        own = {one.name: getattr(objective, one.name) for one in fields(Objective)}
        return cls(**own, chosen=chosen, wish=wish)

    def __call__(self, genome: Genome, floor: float = -np.inf) -> Score:
        """Score of `genome`, times the share of the wished distance that its genome has."""
        score = super().__call__(genome, floor)
        return _times(score, min(genome_distance(genome, look.genome) for look in self.chosen) / self.wish.genome)

    def score(self, plant: Plant, floor: float = -np.inf) -> Score:
        """Score of a plant, times the share of the wished distance that its mask has."""
        score = super().score(plant, floor)
        if score.total <= 0 or self.wish.image <= 0:
            return score
        mine = self.similarity.describe(self.view(plant, self.frame))
        like = max(self.similarity.compare(look.description, mine) for look in self.chosen)
        return _times(score, (1.0 - like) / (MARGIN * self.wish.image))

    def of_look(self, look: Look) -> float:
        """Score of a plant that was grown already."""
        image, genome = np.min([look.apart(other, self) for other in self.chosen], axis=0)
        near = min(image / (MARGIN * self.wish.image), 1.0) if self.wish.image > 0 else 1.0
        return float(look.score.total * near * min(genome / self.wish.genome, 1.0))


def _times(score: Score, share: float) -> Score:
    """Return `score` with a `share` of its total, all of it from 1 on."""
    return score if share >= 1 else replace(score, total=score.total * share)


def runner_up(
    apart: Apart, known: Sequence[Look], race: Race, plants: int, seeds: Seeds, place: tuple[int, int], told: Told
) -> Genome:
    """Best genome (n,) of a search with `plants` plants, from `known` genomes and from between them and the first.

    `place`, which runner-up and how often it was begun, parts the random streams; `told` hears of every batch.
    """
    rng = np.random.default_rng([apart.seed, *place])
    starts = np.array([look.genome for look in known])
    worth = [apart.of_look(look) for look in known]
    best: Genome = starts[int(np.argmax(worth))]
    best_score = max(worth)
    between: NDArray[np.float64] = _between(apart.chosen[0].genome, starts, apart.wish.genome)
    between = between[: int(plants / seeds.plants / 4)]
    gaussian = None if len(between) else around(best, STEP)
    ranks = rates(starts.shape[1], POPULATION)
    fewest = 1 if seeds.count == 1 else 4  # a smaller batch races at more plants each
    while plants >= fewest * seeds.plants:
        normals = rng.standard_normal((POPULATION, starts.shape[1]))
        genomes = between if gaussian is None else mirrored(gaussian.place(gaussian.steps(normals)))
        genomes = genomes[: int(plants / seeds.plants)]
        scores, grown = race(genomes, np.full(len(genomes), -np.inf))
        told(genomes, scores, grown)
        plants -= grown
        totals = np.array([score.total for score in scores])
        if totals.max() > best_score:
            best, best_score = genomes[int(totals.argmax())], float(totals.max())
        if gaussian is None:
            gaussian = around(best, STEP)
        elif len(genomes) == POPULATION:
            gaussian = learn(gaussian, ranks, normals[np.argsort(-totals, kind="stable")])
    return best


def _between(first: Genome, others: NDArray[np.float64], distance: float) -> NDArray[np.float64]:
    """Genomes on the way from the first to each of the others, just as far from it as wished; best others first."""
    way = others - first
    length = np.sqrt((way**2).mean(axis=1, keepdims=True))
    far = np.flatnonzero(length[:, 0] > FARTHER * distance)
    found: NDArray[np.float64] = first + way[far] * (FARTHER * distance / length[far])
    return found
