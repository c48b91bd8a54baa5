"""Fit: the loop of ask, evaluate and tell, from a mask to a few distinct candidates (sec. 3)."""

from __future__ import annotations

import hashlib
import math
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from treefit.candidates import Candidate, choose, judge
from treefit.checkpoint import CheckpointError, read_checkpoint, write_checkpoint
from treefit.evaluation import Evaluator
from treefit.family.hints import hints_of
from treefit.image import AutoMask, Extractor, read_picture
from treefit.mask import Mask, check_mask
from treefit.objective import Objective, View
from treefit.plant import Budget, Generator, Values
from treefit.plant.characteristics import Characteristics
from treefit.progress import Failure, Generation, Progress
from treefit.search import CMAES, Hints, Optimizer, Strategy
from treefit.similarity import Mix, Similarity
from treefit.view import BitMask, OrthographicView, frame_for, sample

PATIENCE = 3
"""Generations without a single score after which a search gives up."""

CHECKPOINT_SECONDS = 1.0
"""Seconds between two checkpoints: a disk may take longer to write one than a generation takes to be scored."""


@dataclass(frozen=True)
class Stop:
    """When to end before the budget is spent: at a score, or after seconds; None for never."""

    score: float | None = None
    seconds: float | None = None


@dataclass(frozen=True, eq=False)
class Result:
    """Candidates, best first, and how the search went."""

    candidates: list[Candidate]
    history: list[Generation]
    failures: dict[str, int]
    target: Mask

    @property
    def evaluations(self) -> int:
        """Count of evaluations."""
        return self.history[-1].evaluations

    @property
    def seconds(self) -> float:
        """Seconds of the search itself."""
        return self.history[-1].seconds


class SearchError(RuntimeError):
    """Nothing could be scored at all; the message says why."""


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
    min_distance: float = 0.1,
    other_seeds: int = 5,
    stop: Stop | None = None,
    checkpoint: Path | None = None,
    start: Sequence[Values] = (),
    on_generation: Callable[[Generation, list[Failure]], None] | None = None,
) -> Result:
    """Find parameters of `generator` whose plants look like `picture`, a mask (h, w) or the path of an image file.

    `start` are values of plants to begin from. Whatever is left out takes the defaults of the configuration; `budget`
    is, when left out, 4 times the wanted vertices. With `checkpoint` the search goes on from that file if it exists,
    and keeps it up to date; the result is the same as that of a search that was never interrupted. Raises ValueError
    for a picture without a tree, CheckpointError for a checkpoint of another search, SearchError when no candidate at
    all could be scored.
    """
    if isinstance(picture, np.ndarray):
        mask = check_mask(picture)
    else:
        mask = (extractor or AutoMask())(read_picture(picture)).mask
    objective = aim(mask, generator, similarity or Mix(), characteristics or Characteristics(),
                    view or OrthographicView(), seed, budget)  # fmt: skip
    strategy = optimizer or CMAES()
    hints = hints_of(objective, mask, start)
    search = strategy.begin(len(objective.space), seed, hints)
    with threadpool_limits(1, "blas"):  # its threads would fight with the evaluator's, and sum in another order
        progress = _search(objective, search, evaluator or Evaluator(), stop or Stop(), checkpoint, on_generation,
                           _fingerprint(objective, mask, strategy, hints))  # fmt: skip
    genomes, _ = search.best(16 * candidates)
    chosen = choose(objective, list(genomes), candidates, min_distance)
    found = [judge(objective, genome, mask, other_seeds) for genome in chosen]
    return Result(found, progress.history, progress.failures, mask)


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
    if budget is None:
        wanted = characteristics.vertices
        budget = Budget() if wanted is None else Budget(max(4 * wanted, 100), max(8 * wanted, 200))
    return Objective(generator, space, view, frame, similarity, target, characteristics, seed, budget)


def _search(
    objective: Objective, search: Optimizer, evaluator: Evaluator, stop: Stop, checkpoint: Path | None,
    on_generation: Callable[[Generation, list[Failure]], None] | None, fingerprint: str,
) -> Progress:  # fmt: skip
    progress = _restore(search, checkpoint, fingerprint)
    if evaluator.backend(objective) != "processes":  # what is compiled now is not on the clock; a crash may end nothing
        objective(np.full(len(objective.space), 0.5))
    started, written = time.perf_counter() - progress.seconds, -math.inf
    with evaluator.started(objective) as evaluate:
        while not search.done and not _enough(progress, stop):
            stage, genomes = search.stage, search.ask()
            scores = evaluate(genomes, search.floors())
            search.tell(np.array([score.total for score in scores]))
            failures = progress.add(stage, objective, genomes, scores, time.perf_counter() - started)
            if progress.best.total == 0.0 and (search.done or len(progress.history) >= PATIENCE):
                reason = progress.first_failure or "all masks were without any likeness"
                raise SearchError(f"no candidate could be scored; the first reason: {reason}")
            last = search.done or _enough(progress, stop)
            if checkpoint is not None and (last or time.perf_counter() - written >= CHECKPOINT_SECONDS):
                write_checkpoint(checkpoint, search.state(), {"fingerprint": fingerprint, "progress": asdict(progress)})
                written = time.perf_counter()
            if on_generation is not None:
                on_generation(progress.history[-1], failures)
    return progress


def _restore(search: Optimizer, checkpoint: Path | None, fingerprint: str) -> Progress:
    if checkpoint is None or not checkpoint.exists():
        return Progress()
    arrays, meta = read_checkpoint(checkpoint)
    if meta.get("fingerprint") != fingerprint:
        raise CheckpointError(f"{checkpoint}: belongs to a search with another picture, generator, seed or settings")
    search.restore(arrays)
    kept: Any = meta["progress"]
    return Progress.from_json(kept)


def _enough(progress: Progress, stop: Stop) -> bool:
    if not progress.history:
        return False
    now = progress.history[-1]
    return (stop.score is not None and now.best >= stop.score) or (
        stop.seconds is not None and now.seconds >= stop.seconds
    )


def _fingerprint(objective: Objective, mask: Mask, strategy: Strategy, hints: Hints) -> str:
    """Hash of everything that the course of the search depends on."""
    settings = (
        objective.generator.name, objective.generator.version, objective.space, objective.view, objective.frame,
        objective.similarity, objective.characteristics, objective.seed, objective.budget, strategy, mask.shape,
        [array.shape for array in hints.arrays],
    )  # fmt: skip
    known = b"".join(array.tobytes() for array in hints.arrays)
    return hashlib.sha256(repr(settings).encode() + mask.tobytes() + known).hexdigest()
