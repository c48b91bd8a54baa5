"""SweepTable: the runs of a sweep as rows (pictures) and columns (what else differs)."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from treefit.tracking.kept_run import run_of

JOB_FILE = "job.json"
PICTURES = ("candidates/1/picture.png", "gallery.png", "mask_overlay.png")
"""What stands for a run in the table: the first of these that it has."""


@dataclass(frozen=True)
class Job:
    """One run of a sweep; `status` is running, done or failed, scores and `facts` are those of its best candidate."""

    folder: Path
    number: int
    overrides: tuple[str, ...]
    image: str
    status: str
    error: str
    score: float | None = None
    score_other_seeds: float | None = None
    facts: Mapping[str, float] = field(default_factory=dict)
    run: str | None = None  # its identity in the tracking

    @property
    def picture(self) -> Path | None:
        """Picture of the best candidate, None when there is none."""
        return next((self.folder / name for name in PICTURES if (self.folder / name).is_file()), None)

    @property
    def choices(self) -> dict[str, str]:
        """Overrides by name, without the picture."""
        pairs = (override.partition("=") for override in self.overrides)
        return {name.lstrip("+"): value for name, _, value in pairs if name.lstrip("+") != "image"}


@dataclass(frozen=True)
class SweepTable:
    """Jobs by (row, column); a row is the path of a picture, a column what was chosen."""

    rows: tuple[str, ...]
    columns: tuple[str, ...]
    cells: Mapping[tuple[str, str], Job]


def write_job(folder: Path, number: int, overrides: Sequence[str], image: str, status: str, error: str = "") -> None:
    """Keep in the run's folder what the table needs to know of it."""
    record = {"number": number, "overrides": [*overrides], "image": image, "status": status, "error": error}
    (folder / JOB_FILE).write_text(json.dumps(record, indent=1), encoding="utf-8")


def read_jobs(folder: Path) -> list[Job]:
    """Jobs whose folders are in the sweep's `folder`, in the order of their numbers."""
    return sorted((_read_job(file) for file in folder.rglob(JOB_FILE)), key=lambda job: job.number)


def tabulate(jobs: Sequence[Job]) -> SweepTable:
    """Table of `jobs`; settings that are the same in all of them are left out of the columns' names."""
    names = {name: None for job in jobs for name in job.choices}
    differing = [name for name in names if len({job.choices.get(name) for job in jobs}) > 1]
    cells = {(job.image, _column(job, differing)): job for job in jobs}
    rows = dict.fromkeys(row for row, _ in cells)
    columns = dict.fromkeys(column for _, column in cells)
    return SweepTable(tuple(rows), tuple(columns), cells)


def _column(job: Job, differing: Sequence[str]) -> str:
    if differing == ["generator"]:
        return job.choices["generator"]
    return " ".join(f"{name}={job.choices[name]}" for name in differing if name in job.choices) or "result"


def _read_job(file: Path) -> Job:
    record = json.loads(file.read_text(encoding="utf-8"))
    facts = _facts(file.parent / "summary.json")
    return Job(
        folder=file.parent,
        number=int(record["number"]),
        overrides=tuple(record["overrides"]),
        image=str(record["image"]),
        status=str(record["status"]),
        error=str(record["error"]),
        score=facts.get("score"),
        score_other_seeds=facts.get("score_other_seeds"),
        facts=facts,
        run=run_of(file.parent),
    )


def _facts(file: Path) -> dict[str, float]:
    """Numbers known of the best candidate, by name; none when the run has no summary."""
    if not file.is_file():
        return {}
    summary = json.loads(file.read_text(encoding="utf-8"))
    best = (summary.get("candidates") or [summary])[0]
    return {name: float(value) for name, value in best.items() if isinstance(value, float | int)}
