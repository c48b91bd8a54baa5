"""Job and Run: one fit of the task compare, to be done in a process of its own, and what is kept of it."""

from __future__ import annotations

import hashlib
import json
from bisect import bisect_left, bisect_right
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from math import inf
from pathlib import Path
from typing import Any

from experiments.compare_recorder import Record, Recorded
from experiments.errors import one_line
from treefit.evaluation import Evaluator
from treefit.fit import fit
from treefit.mask import Mask
from treefit.objective import View
from treefit.plant import Generator
from treefit.plant.characteristics import Characteristics
from treefit.search import Strategy
from treefit.similarity import Similarity


@dataclass(frozen=True)
class Label:
    """Which run: generator, target and optimiser by name, and the repeat, from 0."""

    generator: str
    target: str
    optimizer: str
    repeat: int

    def __str__(self) -> str:
        """Words for the terminal."""
        return f"{self.generator}, {self.target}, {self.optimizer}, repeat {self.repeat + 1}"


@dataclass(frozen=True)
class Run:
    """What is kept of a fit: its best score rose to `scores` at the evaluations `steps`.

    `seconds` are processor time of the search, `own_seconds` those of them that the optimiser took itself.
    """

    label: Label
    evaluations: int
    steps: tuple[int, ...]
    scores: tuple[float, ...]
    score_other_seeds: float | None
    seconds: float
    own_seconds: float
    failures: int
    values: Mapping[str, Any] = field(default_factory=dict)

    def at(self, evaluations: float) -> float:
        """Best score after so many evaluations, 0 before the first."""
        i = bisect_right(self.steps, evaluations)
        return self.scores[i - 1] if i else 0.0

    def reaches(self, score: float) -> float:
        """Evaluations after which the best score is `score` or more, inf when it never is."""
        i = bisect_left(self.scores, score)
        return self.steps[i] if i < len(self.steps) else inf


@dataclass(frozen=True)
class Failed:
    """A run that could not be had, and why."""

    label: Label
    reason: str


@dataclass(frozen=True, eq=False)
class Job:
    """All that a run depends on; `settings_of_generator` says it in words."""

    label: Label
    target: Mask
    generator: Generator
    settings_of_generator: str
    strategy: Strategy
    similarity: Similarity[Any]
    characteristics: Characteristics
    view: View
    seed: int
    other_seeds: int

    @property
    def settings(self) -> str:
        """Hash of all that the run depends on but for the code of the search and what is known of the generator."""
        words = (
            self.generator.name, self.generator.version, self.settings_of_generator, self.strategy, self.similarity,
            self.characteristics, self.view, self.seed, self.other_seeds, self.target.shape,
        )  # fmt: skip
        return hashlib.sha256(repr(words).encode() + self.target.tobytes()).hexdigest()


def attempt(job: Job) -> Run | Failed:
    """Run of a job, on one core; a fit that fails must not end the others."""
    record = Record()
    try:
        found = fit(job.target, job.generator, similarity=job.similarity, characteristics=job.characteristics,
                    view=job.view, optimizer=Recorded(job.strategy, record), evaluator=Evaluator(kind="serial"),
                    seed=job.seed, candidates=1, other_seeds=job.other_seeds)  # fmt: skip
    except Exception as error:
        return Failed(job.label, f"{type(error).__name__}: {one_line(error)}")
    best = found.candidates[0]
    return Run(job.label, record.evaluations, tuple(record.steps), tuple(record.scores), best.score_other_seeds,
               record.total, record.own, sum(found.failures.values()), dict(best.values))  # fmt: skip


def keep(run: Run, settings: str, folder: Path) -> None:
    """Write `run` and the `settings` that it came from to `folder`, at once or not at all."""
    file = _file(run.label, folder)
    file.parent.mkdir(parents=True, exist_ok=True)
    unfinished = file.with_suffix(".tmp")
    unfinished.write_text(json.dumps({"settings": settings, **asdict(run)}), encoding="utf-8")
    unfinished.replace(file)


def kept(label: Label, settings: str, folder: Path) -> Run | None:
    """Run that is kept in `folder`; None when there is none of the same `settings`."""
    file = _file(label, folder)
    if not file.exists():
        return None
    facts: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    if facts.pop("settings") != settings:
        return None
    curve = {name: tuple(facts.pop(name)) for name in ("steps", "scores")}
    return Run(**{**facts, **curve, "label": Label(**facts["label"])})


def _file(label: Label, folder: Path) -> Path:
    return folder / "runs" / label.generator / label.target / f"{label.optimizer}_{label.repeat + 1}.json"
