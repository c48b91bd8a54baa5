"""Sample: plants of random genomes that the rules of the contract look at, each grown once for all of them."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from treefit.plant.contract.faults import ContractError, NotTried, reason
from treefit.plant.contract.same import apart, digest
from treefit.plant.generator import Budget, Generator
from treefit.plant.parameters import Genome, Values
from treefit.plant.plant import Plant, check_plant

TRIES, PATIENCE = 10, 20.0
"""When the first plants all fail, no more are tried after so many, or after so many seconds."""

Shown = Callable[[Sequence[Genome]], Iterable[Genome]]


@dataclass(frozen=True, eq=False)
class Attempt:
    """One call of a generator: the plant, or why there is none; the time it took, and what it did to its input."""

    values: Values
    seed: int
    plant: Plant | None
    failure: str
    seconds: float
    digest: bytes = b""  # of the plant when it was new
    touched: bool = False  # whether the generator changed the values that were handed to it


@dataclass(frozen=True, eq=False)
class Sample:
    """A generator, its `attempts` at random genomes within `budget`, and one at its defaults.

    Rules that grow plants again do so with `few` of them.
    """

    generator: Generator
    attempts: Sequence[Attempt]
    default: Attempt
    budget: Budget
    few: int

    @property
    def grown(self) -> list[tuple[Attempt, Plant]]:
        """Attempts that gave a valid plant; NotTried when there are none."""
        found = [(attempt, attempt.plant) for attempt in self.attempts if attempt.plant is not None]
        if not found:
            raise NotTried("there is no plant")
        return found

    @property
    def typical(self) -> tuple[Attempt, Plant]:
        """The plant of the defaults when there is one that is whole, else one of a random genome, whole if possible."""
        if self.default.plant is not None and not self.default.plant.cut:
            return self.default, self.default.plant
        return min(self.grown, key=lambda pair: pair[1].cut)

    def again(self, attempt: Attempt, budget: Budget | None = None) -> Plant:
        """Plant of the values of an `attempt` that gave one before; ContractError when there is none now."""
        found = grow(self.generator, attempt.values, attempt.seed, budget or self.budget)
        if found.plant is None:
            limits = f" within {budget.vertices} vertices and {budget.leaves} leaves" if budget else " again"
            raise ContractError(f"gives a plant, but none{limits}: {found.failure}", attempt.values, attempt.seed)
        return found.plant

    def other(self, seed: int, values: Values) -> Plant | None:
        """Plant of further `values` or another `seed`, None when there is none: generators may fail now and then."""
        return grow(self.generator, values, seed, self.budget).plant


def draw_sample(
    generator: Generator, count: int, *, few: int = 8, seed: int = 0, budget: Budget | None = None, shown: Shown = iter
) -> Sample:
    """Grow `count` random genomes of `generator`, fewer when none of the first gives a plant.

    `shown` is handed the genomes and gives them back, and may show how far it is.
    """
    limits = budget or Budget()
    genomes = list(np.random.default_rng(seed).random((count, len(generator.space))))
    default = grow(generator, generator.space.complete({}), seed, limits)  # first: what it compiles is not timed
    began, attempts = time.perf_counter(), list[Attempt]()
    for genome in shown(genomes):
        found = grow(generator, generator.space.decode(genome), seed, limits)
        kept = found.plant if found.plant is None or len(attempts) < few else apart(found.plant)
        attempts.append(replace(found, plant=kept))
        waited = time.perf_counter() - began
        if (len(attempts) >= TRIES or waited > PATIENCE) and all(attempt.plant is None for attempt in attempts):
            break
    return Sample(generator, attempts, default, limits, few)


def grow(generator: Generator, values: Values, seed: int, budget: Budget) -> Attempt:
    """Call `generator`, whatever it does."""
    given = dict(values)
    began = time.perf_counter()
    try:
        plant = generator(given, seed, budget)
        seconds = time.perf_counter() - began
        if not isinstance(plant, Plant):
            raise TypeError(f"a Plant must be returned, got {type(plant).__name__}")
        check_plant(plant)
    except Exception as error:
        return Attempt(values, seed, None, reason(error), time.perf_counter() - began, touched=given != values)
    return Attempt(values, seed, plant, "", seconds, digest(plant), given != values)


def narrower(sample: Sample, count: int) -> Sample:
    """Return `sample` with a tenth of its budget and `count` attempts, grown anew."""
    budget = Budget(max(sample.budget.vertices // 10, 2), sample.budget.leaves // 10)
    attempts = [grow(sample.generator, one.values, one.seed, budget) for one, _ in sample.grown[:count]]
    return replace(sample, attempts=attempts, budget=budget)
