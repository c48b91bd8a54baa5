"""Trial of a foreign generator: random trees of a space, and what became of each, from any number of workers."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from experiments.errors import one_line
from experiments.sheet_cells import BUDGET, grow, same
from experiments.terminal import counted
from treefit.evaluation import in_parallel
from treefit.plant import Generator, ParameterSpace, Plant, Value, Values, check_plant
from treefit.plant.extent import extent_of
from treefit.view import BitMask, Frame, OrthographicView

FRAME = Frame(96, 4)
"""Window in which trees are compared, 1.3 heights to both sides."""

ENOUGH = 0.8
"""Share of random genomes that should grow."""

FLATTEST = 0.02
"""Height by width under which a plant lies on the ground."""

_VIEW = OrthographicView(resolution=FRAME.height)

Job = TypeVar("Job")
Found = TypeVar("Found")


@dataclass(frozen=True, eq=False)
class Tree:
    """What became of one call: a tree with its counts and its mask, or `kind` and `reason` of the failure."""

    values: Values
    seed: int
    seconds: float
    kind: str = ""
    reason: str = ""
    vertices: int = 0
    leaves: int = 0
    height: float = 0.0  # m
    mask: BitMask | None = None

    @property
    def grew(self) -> bool:
        """Whether it is a tree."""
        return self.mask is not None


@dataclass(frozen=True, eq=False)
class Trial:
    """Trees (m,) of the genomes (m, n) of `space`."""

    space: ParameterSpace
    genomes: NDArray[np.float64]
    trees: Sequence[Tree]

    @property
    def good(self) -> list[Tree]:
        """Those that grew."""
        return [tree for tree in self.trees if tree.grew]

    @property
    def share(self) -> float:
        """Share that grew."""
        return len(self.good) / len(self.trees)


def try_values(generator: Generator, job: tuple[dict[str, Value], int]) -> Tree:
    """Tree of a job (values, seed), or why there is none."""
    values, seed = job
    start = time.perf_counter()
    try:
        plant = generator(values, seed, BUDGET)
        seconds = time.perf_counter() - start
        check_plant(plant)
    except Exception as error:
        return Tree(values, seed, time.perf_counter() - start, type(error).__name__, one_line(error))
    extent = extent_of(plant)
    if plant.cut:
        return Tree(values, seed, seconds, "TooLarge", f"over {BUDGET.vertices:,} vertices or {BUDGET.leaves:,} leaves")
    if extent.height < FLATTEST * extent.width or extent.height < 1e-4:
        return Tree(values, seed, seconds, "Flat", "it lies on the ground")
    return _seen(values, seed, seconds, plant, extent.height)


def try_genomes(generator: Generator, seeds: Sequence[int], what: str) -> Trial:
    """Trial of a random genome on each of `seeds`; `what` is said of the progress."""
    space = generator.space
    genomes = np.array([np.random.default_rng(seed).random(len(space)) for seed in seeds])
    jobs = [(space.decode(genome), seed) for genome, seed in zip(genomes, seeds, strict=True)]
    return Trial(space, genomes, at_once(generator, partial(try_values, generator), jobs, what))


def joined(one: Trial, two: Trial) -> Trial:
    """Both trials of a space as one."""
    return Trial(one.space, np.concatenate([one.genomes, two.genomes]), [*one.trees, *two.trees])


def same_again(generator: Generator, trees: Sequence[Tree]) -> tuple[int, int]:
    """How many of `trees` are the same when they grow twice more, and of how many."""
    twice = [[grow(generator, tree.values, tree.seed) for _ in range(2)] for tree in trees]
    return sum(isinstance(one, Plant) and same(one, two) for one, two in twice), len(twice)


def at_once(generator: Generator, function: Callable[[Job], Found], jobs: Sequence[Job], what: str) -> list[Found]:
    """`function` of each of `jobs` in order, by as many workers as there are cores, with a bar."""
    results = in_parallel(function, jobs, kind=generator.parallel)
    return [next(results) for _ in counted(range(len(jobs)), what)]


def _seen(values: Values, seed: int, seconds: float, plant: Plant, height: float) -> Tree:
    mask = _VIEW(plant, FRAME)
    if not (mask.branch.any() or mask.foliage.any()):
        return Tree(values, seed, seconds, "Unseen", "no pixel of it is seen")
    return Tree(values, seed, seconds, "", "", plant.n_vertices, plant.n_leaves, height, mask)
