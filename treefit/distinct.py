"""Distinct candidates: which of the good genomes look different, and differ, enough to be shown beside each other."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations

import numpy as np

from treefit.objective import Objective, Score
from treefit.plant import Genome
from treefit.regrowth import Regrowth, UngrownError

LEAST = 0.01
"""Distance of two candidates at least, of masks as of genomes: under it they are one and the same tree."""

HALVINGS = 3
"""How often the wished distance is halved while candidates are missing."""

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Distinct:
    """What candidates must be: `image` apart, 1 - image similarity of two, and `within` this share of the best score.

    Their genomes are at least `genome` apart, as root mean square over the genes.
    """

    image: float = 0.15
    within: float = 0.08
    genome: float = 0.25

    def relaxed(self) -> list[Distinct]:
        """The wish itself, then with half the distances again and again, but never under the least."""
        halved = (np.maximum(np.array([self.image, self.genome]) / 2**i, LEAST).tolist() for i in range(HALVINGS + 1))
        return [Distinct(image, self.within, genome) for image, genome in halved]


@dataclass(frozen=True, eq=False)
class Look:
    """A genome (n,), its score, and the description of its mask on the seed of the search, as it is compared."""

    genome: Genome
    score: Score
    description: object

    @classmethod
    def of(cls, objective: Objective, genome: Genome) -> Look | None:
        """Look of `genome`; None when its plant has no score; UngrownError when it had one, as far as anybody knows."""
        score = objective.mean(genome)
        if score.failure is not None and not objective.generator.pure:
            raise UngrownError(score.failure)
        if score.total <= 0:
            return None
        plant = objective.grow(genome, objective.seed)
        return cls(genome, score, objective.similarity.describe(objective.view(plant, objective.frame)))

    def apart(self, other: Look, objective: Objective) -> tuple[float, float]:
        """Distance of the two masks, and of the genomes."""
        image = 1.0 - objective.similarity.compare(other.description, self.description)
        return image, genome_distance(self.genome, other.genome)


def genome_distance(one: Genome, two: Genome) -> float:
    """Root mean square over the genes."""
    return float(np.sqrt(((one - two) ** 2).mean()))


def looks(objective: Objective, genomes: Iterable[Genome], regrowth: Regrowth | None = None) -> list[Look]:
    """Looks of what can be scored of `genomes`, best first; what cannot be grown again is left out."""
    regrowth = regrowth or Regrowth(objective)
    tried = (regrowth.of(genome, partial(Look.of, objective, genome)) for genome in genomes)
    found = [look for look in tried if look is not None]
    return sorted(found, key=lambda look: -look.score.total)


def choose(objective: Objective, ranked: Sequence[Look], count: int, wish: Distinct) -> list[Look]:
    """At most `count` of `ranked` (best first) as distinct as wished, best first.

    While too few are, the distances are halved, but never the share of the best score that a candidate needs.
    """
    good = [look for look in ranked if look.score.total >= (1 - wish.within) * ranked[0].score.total]
    chosen: list[Look] = []
    for rule in wish.relaxed():
        for look in good:
            if len(chosen) == count:
                break
            apart = (look.apart(other, objective) for other in chosen)
            if look not in chosen and all(image >= rule.image and genome >= rule.genome for image, genome in apart):
                chosen.append(look)
        if len(chosen) == count:
            break
    if len(chosen) < count:
        _log.warning("%s of %s candidates: nothing else that is different was within %.0f %% of the best score",
                     len(chosen), count, 100 * wish.within)  # fmt: skip
    images = [one.apart(two, objective)[0] for one, two in combinations(chosen, 2)]
    if images and min(images) < wish.image:
        _log.warning("the candidates look %.2f apart, not %.2f: no others were within %.0f %% of the best score",
                     min(images), wish.image, 100 * wish.within)  # fmt: skip
    return sorted(chosen, key=lambda look: -look.score.total)
