"""Objective: one genome becomes one score (sec. 4); small, picklable, and it never raises for a bad plant."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

from treefit.plant import Budget, Generator, Genome, ParameterSpace, Plant, check_plant
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Similarity
from treefit.view.frame import BitMask, Frame


class View(Protocol):
    """Turns a plant into a mask."""

    @property
    def resolution(self) -> int:
        """Rows of pixels in the height of a plant."""

    @property
    def parallel(self) -> str:
        """How several calls run at once: "threads" or "processes"."""

    @property
    def reduce(self) -> str:
        """How the image similarities of several sides are joined: mean, best or worst."""

    def __call__(self, plant: Plant, frame: Frame) -> BitMask:
        """Bit rows of `plant` in `frame`, from the front."""

    def sides(self, plant: Plant, frame: Frame) -> Sequence[BitMask]:
        """Bit rows from every side that the score sees, the front first."""


REDUCE: Mapping[str, Callable[[Sequence[float]], float]] = {
    "mean": lambda images: sum(images) / len(images), "best": max, "worst": min,
}  # fmt: skip
"""How the image similarities of several sides are joined, by name."""


OVER_BUDGET = "over budget"
"""How the failure of a plant begins that has more vertices or leaves than the budget."""

UNGROWN = "not grown"
"""Failure of a candidate that nobody tried to grow."""


@dataclass(frozen=True)
class Score:
    """Sim = ImSim times the characteristic multipliers; `failure` says why a candidate could not be scored.

    A candidate that was not `drawn` has total and image 0: its multipliers alone showed that it could not matter.
    """

    total: float
    image: float = 0.0
    multipliers: Mapping[str, float] = field(default_factory=dict)
    failure: str | None = None
    drawn: bool = True


@dataclass(frozen=True, eq=False)
class Objective:
    """The function on [0, 1]^n that the search maximises: genomes of `space` against the described `target`."""

    generator: Generator
    space: ParameterSpace
    view: View
    frame: Frame
    similarity: Similarity[Any]
    target: object
    characteristics: Characteristics
    seed: int
    budget: Budget
    further_seeds: tuple[int, ...] = ()

    @property
    def seeds(self) -> tuple[int, ...]:
        """Seeds whose mean score counts, that of the search first; a call tells the score on that one alone."""
        return self.seed, *self.further_seeds

    def __call__(self, genome: Genome, floor: float = -math.inf) -> Score:
        """Score of `genome` (n,); 0 with the reason when the generator fails or its plant is not usable.

        A score over `floor` is exact; one that cannot be over it may be 0.
        """
        try:
            return self.score(self.grow(genome, self.seed), floor)
        except Exception as error:  # a foreign generator may raise anything, and must not end the run
            return Score(0.0, failure=reason_of(error))

    def on(self, seed: int) -> Objective:
        """Return the same objective on another seed, and on no further one."""
        return replace(self, seed=seed, further_seeds=())

    def mean(self, genome: Genome) -> Score:
        """Mean score of `genome` (n,) over all seeds."""
        return mean_score([self.on(seed)(genome) for seed in self.seeds], self.seeds)

    def grow(self, genome: Genome, seed: int) -> Plant:
        """Plant of `genome` on `seed`, with nothing wrong in its numbers; a generator may raise anything instead."""
        plant = self.generator(self.space.decode(genome), seed, self.budget)
        check_plant(plant)
        return plant

    def score(self, plant: Plant, floor: float = -math.inf) -> Score:
        """Score of a plant; 0 when the budget cut it, or when the image, at most 1, cannot lift it over `floor`."""
        if plant.cut:
            limits = f"{self.budget.vertices} vertices, {self.budget.leaves} leaves"
            return Score(0.0, failure=f"{OVER_BUDGET}: more than {limits}")
        multipliers = self.characteristics.multipliers(plant)
        bound = math.prod(multipliers.values())
        if bound <= floor:
            return Score(0.0, multipliers=multipliers, drawn=False)
        sides = self.view.sides(plant, self.frame)
        looks = [self.similarity.describe(side) for side in sides]
        image = REDUCE[self.view.reduce]([self.similarity.compare(self.target, look) for look in looks])
        total = image * bound * self.allowance(looks[0])
        if not math.isfinite(total):
            return Score(0.0, failure=f"the score is not a number: image {image}, multipliers {multipliers}")
        return Score(total, image, multipliers)

    def allowance(self, front: object) -> float:  # noqa: ARG002
        """Factor of the score, 1 or under, by the description of the plant from the front; of no concern here."""
        return 1.0


def reason_of(error: BaseException) -> str:
    """One line that begins with the kind of `error`."""
    return f"{type(error).__name__}: {error}".splitlines()[0][:500]


def mean_score(scores: Sequence[Score], seeds: Sequence[int]) -> Score:
    """Mean of the scores of one genome on `seeds`, a failure counting 0; its failure is the first, with the seed."""
    if len(scores) == 1:
        return scores[0]
    kinds = dict.fromkeys(kind for score in scores for kind in score.multipliers)
    reasons = (f"{score.failure} (seed {seed})" for score, seed in zip(scores, seeds, strict=False) if score.failure)
    return Score(
        sum(score.total for score in scores) / len(scores),
        sum(score.image for score in scores) / len(scores),
        {kind: sum(score.multipliers.get(kind, 0.0) for score in scores) / len(scores) for kind in kinds},
        next(reasons, None),
        all(score.drawn for score in scores),
    )
