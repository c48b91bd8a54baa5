"""Fit: the loop of ask, evaluate and tell, from a mask to a few distinct candidates (sec. 3)."""

from __future__ import annotations

import hashlib
import math
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from treefit.candidates import Candidate, judged
from treefit.checkpoint import CheckpointError, read_checkpoint, write_checkpoint
from treefit.confirm import trusted
from treefit.distinct import Distinct, looks
from treefit.evaluation import Evaluator
from treefit.family.hints import hints_of
from treefit.image import AutoMask, Extractor, read_picture
from treefit.improvements import Improvement
from treefit.listeners import Listeners, OnGeneration, OnImprovement, OnLeftOut
from treefit.mask import Mask, check_mask
from treefit.objective import Objective, Score, View
from treefit.placing import place
from treefit.plant import Budget, Generator, Values
from treefit.plant.characteristics import Characteristics
from treefit.progress import Generation, Progress
from treefit.racing import Seeds
from treefit.regrowth import Regrowth, SearchError
from treefit.runners_up import MOST, RunnersUp, Told
from treefit.search import CMAES, Hints, Optimizer, Strategy
from treefit.similarity import Mix, Similarity
from treefit.stop import Stop
from treefit.view import BitMask, OrthographicView, frame_for, sample
from treefit.watch import Watch

PATIENCE = 3
"""Generations without a single score after which a search gives up."""

MOST_LOOKED_AT = 64
"""Genomes of a search that candidates are chosen from."""

CHECKPOINT_SECONDS = 1.0
"""Seconds between two checkpoints: a disk may take longer to write one than a generation takes to be scored."""


@dataclass(frozen=True, eq=False)
class Result:
    """Candidates, best first, and how the search went; `objective.grow` makes a plant of a genome that it had."""

    candidates: list[Candidate]
    history: list[Generation]
    failures: dict[str, int]
    target: Mask
    improvements: list[Improvement]
    objective: Objective

    @property
    def evaluations(self) -> int:
        """Count of evaluations."""
        return self.history[-1].evaluations

    @property
    def seconds(self) -> float:
        """Seconds of the search itself."""
        return self.history[-1].seconds


def fit(
    picture: Mask | str | Path,
    generator: Generator,
    *,
    extractor: Extractor | None = None,
    similarity: Similarity[Any] | None = None,
    characteristics: Characteristics | None = None,
    view: View | None = None,
    optimizer: Strategy | None = None,
    evaluator: Evaluator | None = None,
    seed: int = 0,
    budget: Budget | None = None,
    candidates: int = 3,
    distinct: Distinct | None = None,
    runners_up: float = 0.1,
    seeds: Seeds | None = None,
    other_seeds: int = 5,
    stop: Stop | None = None,
    checkpoint: Path | None = None,
    start: Sequence[Values] = (),
    on_generation: OnGeneration | None = None,
    on_improvement: OnImprovement | None = None,
    on_left_out: OnLeftOut | None = None,
) -> Result:
    """Find parameters of `generator` whose plants look like `picture`, a mask (h, w) or the path of an image file.

    `start` are values of plants to begin from. Whatever is left out takes the defaults of the configuration; `budget`
    is, when left out, 4 times the most vertices that are wished for. With `checkpoint` the search goes on from that
    file if it exists, and keeps it up to date; the result is the same as that of a search that was never interrupted.
    `on_generation` is told of each batch, `on_improvement` of each new best plant, `on_left_out` of what a foreign
    generator could not grow again. One that fails on and on ends the search early, with what was found.
    Raises ValueError for a picture without a tree, CheckpointError for a checkpoint of another search, SearchError when
    no candidate at all could be scored.
    """
    mask = _mask(picture, extractor or AutoMask())
    objective = aim(mask, generator, similarity or Mix(), characteristics or Characteristics(),
                    view or OrthographicView(), seed, budget)  # fmt: skip
    wish, seeds, evaluator = distinct or Distinct(), seeds or Seeds(), evaluator or Evaluator()
    objective = replace(objective, further_seeds=seeds.further(seed))
    optimizer, plants = optimizer or CMAES(), (optimizer or CMAES()).evaluations
    share = min(runners_up, (candidates - 1) * MOST * seeds.plants / plants)
    strategy = _with_budget(optimizer, round((1 - share) * plants), seeds)
    with threadpool_limits(1, "blas"):  # its threads would fight with the evaluator's, and sum in another order
        hints = hints_of(objective, mask, start)
        search = strategy.begin(len(objective.space), seed, hints)
        listeners, watch = (
            Listeners(objective, on_generation, on_improvement, on_left_out),
            Watch.of(generator, evaluator),
        )
        progress = _search(objective, search, evaluator, seeds, (stop or Stop()).earlier(share, plants), checkpoint,
                           listeners, _fingerprint(objective, mask, strategy, hints, seeds), watch)  # fmt: skip
        regrowth = Regrowth(objective, lambda failure: listeners.left_out(progress, failure), watch.dead)
        ranked = looks(objective, search.best(MOST_LOOKED_AT)[0], regrowth)
        if share and ranked and not watch.dead:
            left = min(plants - progress.evaluations, round(progress.evaluations * share / (1 - share)) + 1)
            told = _tells(objective, progress, listeners)
            runners = RunnersUp(objective, wish, hints, evaluator, seeds, watch, regrowth.afresh())
            ranked = runners.added(ranked, candidates, left, told)
    found = judged(objective, ranked, candidates, wish, mask, other_seeds, regrowth.afresh())
    return Result(found, progress.history, progress.failures, mask, progress.improvements, objective)


def _mask(picture: Mask | str | Path, extractor: Extractor) -> Mask:
    return check_mask(picture) if isinstance(picture, np.ndarray) else extractor(read_picture(picture)).mask


def aim(
    mask: Mask, generator: Generator, similarity: Similarity[Any], characteristics: Characteristics, view: View,
    seed: int, budget: Budget | None = None,
) -> Objective:  # fmt: skip
    """Objective of a fit to `mask`; the size parameter is searched only when a wished characteristic sees it."""
    frame = frame_for(mask, view.resolution)
    target = similarity.describe(BitMask.pack(sample(mask, frame)))
    space = generator.space
    if generator.size_parameter is not None and characteristics.sees_size:
        space = space.release(generator.size_parameter)
    characteristics = characteristics.for_picture(place(mask).width)
    return Objective(generator, space, view, frame, similarity, target, characteristics, seed,
                     budget or characteristics.budget)  # fmt: skip


def _search(
    objective: Objective, search: Optimizer, evaluator: Evaluator, seeds: Seeds, stop: Stop, checkpoint: Path | None,
    listeners: Listeners, fingerprint: str, watch: Watch,
) -> Progress:  # fmt: skip
    progress = _restore(search, checkpoint, fingerprint)
    if evaluator.backend(objective) != "processes":  # what is compiled now is not on the clock; a crash may end nothing
        objective(np.full(len(objective.space), 0.5))
    started, written = time.perf_counter() - progress.seconds, -math.inf
    with trusted(evaluator, objective, seeds, watch, progress.best.total) as evaluate:
        while not search.done and not stop.reached(progress) and not watch.dead:
            stage, genomes = search.stage, search.ask()
            scores, plants = evaluate(genomes, search.floors())
            search.tell(np.array([score.total for score in scores]))
            failures = progress.add(stage, objective, genomes, scores, time.perf_counter() - started, plants)
            if progress.best.total == 0.0 and (search.done or watch.dead or len(progress.history) >= PATIENCE):
                listeners.tell(progress, failures)
                reason = progress.first_failure or "all masks were without any likeness"
                raise SearchError(f"no candidate could be scored; the first reason: {reason}")
            last = search.done or stop.reached(progress)
            if (
                checkpoint is not None
                and not watch.in_doubt
                and (last or time.perf_counter() - written >= CHECKPOINT_SECONDS)
            ):
                write_checkpoint(checkpoint, search.state(), {"fingerprint": fingerprint, "progress": asdict(progress)})
                written = time.perf_counter()
            listeners.tell(progress, failures)
    return progress


def _with_budget(strategy: Strategy, plants: int, seeds: Seeds) -> Strategy:
    """Return `strategy` with the count of genomes that `plants` plants are enough for."""
    genomes = max(1, int(plants / seeds.plants))
    return strategy if genomes == strategy.evaluations else replace(cast(Any, strategy), evaluations=genomes)


def _tells(objective: Objective, progress: Progress, listeners: Listeners) -> Callable[[str], Told]:
    """Return what makes, of the name of a stage, a function that adds batches to `progress`."""
    started = time.perf_counter() - progress.seconds

    def stage(name: str) -> Told:
        def told(genomes: NDArray[np.float64], scores: list[Score], plants: int) -> None:
            seconds = time.perf_counter() - started
            failures = progress.add(name, objective, genomes, scores, seconds, plants)
            listeners.tell(progress, failures)

        return told

    return stage


def _restore(search: Optimizer, checkpoint: Path | None, fingerprint: str) -> Progress:
    if checkpoint is None or not checkpoint.exists():
        return Progress()
    arrays, meta = read_checkpoint(checkpoint)
    if meta.get("fingerprint") != fingerprint:
        raise CheckpointError(f"{checkpoint}: belongs to a search with another picture, generator, seed or settings")
    search.restore(arrays)
    kept: Any = meta["progress"]
    return Progress.from_json(kept)


def _fingerprint(objective: Objective, mask: Mask, strategy: Strategy, hints: Hints, seeds: Seeds) -> str:
    """Hash of everything that the course of the search depends on."""
    settings = (
        objective.generator.name, objective.generator.version, objective.space, objective.view, objective.frame,
        objective.similarity, objective.characteristics, objective.seeds, seeds, objective.budget, strategy, mask.shape,
        [array.shape for array in hints.arrays],
    )  # fmt: skip
    known = b"".join(array.tobytes() for array in hints.arrays)
    return hashlib.sha256(repr(settings).encode() + mask.tobytes() + known).hexdigest()
