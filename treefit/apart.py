"""Apart: the objective of a runner-up, which must not come near to the trees that are chosen already."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from treefit.distinct import Distinct, Look, genome_distance
from treefit.objective import Objective, Score
from treefit.plant import Genome

MARGIN = 1.02
"""How much farther than wished a runner-up is looked for: the best is often just where the penalty ends."""


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
        near = min(genome_distance(genome, look.genome) for look in self.chosen) / (MARGIN * self.wish.genome)
        return score if near >= 1 else replace(score, total=score.total * near)

    def allowance(self, front: object) -> float:
        """Share of the wished distance that the mask has, 1 at most."""
        if self.wish.image <= 0:
            return 1.0
        like = max(self.similarity.compare(look.description, front) for look in self.chosen)
        return min((1.0 - like) / (MARGIN * self.wish.image), 1.0)

    def of_look(self, look: Look) -> float:
        """Score of a plant that was grown already."""
        image, genome = np.min([look.apart(other, self) for other in self.chosen], axis=0)
        near = min(image / (MARGIN * self.wish.image), 1.0) if self.wish.image > 0 else 1.0
        return float(look.score.total * near * min(genome / (MARGIN * self.wish.genome), 1.0))
