"""Stages of a search as its history tells them: levels of a tree of GAs, restarts, searches for further candidates."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

from treefit.progress import Generation

_NAME = re.compile(r"(?P<name>.*?)(?:, (?P<count>\d+) x)?(?:,? generation \d+.*)?")
"""A stage and its generation, as in "level 2/4, 4 x generation 12" or "start 3, generation 8, spread 0.031"."""


@dataclass(frozen=True)
class Stage:
    """Generations of one name, from `first` to `last` evaluations; `count` elementary GAs work side by side."""

    name: str
    count: int
    first: int
    last: int


@dataclass(frozen=True)
class Label:
    """What is written over a part of the curve: the first of `words` that has room there."""

    words: tuple[str, ...]
    first: int
    last: int


def stage_name(stage: str) -> str:
    """Name of the stage without its generation, as in "level 2/4"."""
    return _parts(stage)[0]


def stages_of(history: Sequence[Generation]) -> list[Stage]:
    """Stages of a search in their order."""
    stages: list[Stage] = []
    for (name, count), lines in groupby(history, key=lambda line: _parts(line.stage)):
        first = stages[-1].last if stages else 0
        stages.append(Stage(name, count, first, list(lines)[-1].evaluations))
    return stages


def labels_of(stages: Sequence[Stage]) -> list[Label]:
    """Labels of `stages`; further candidates, whose searches are short, share one."""
    further = [stage for stage in stages if stage.name.startswith("candidate ")]
    labels = [Label(_words(stage), stage.first, stage.last) for stage in stages if stage not in further]
    if not further:
        return labels
    numbers = [stage.name.removeprefix("candidate ") for stage in further]
    told = ", ".join(numbers) if len(numbers) < 3 else f"{numbers[0]}–{numbers[-1]}"
    words = (f"candidate{'s' if len(numbers) > 1 else ''} {told}", f"cand. {told}", told)
    return [*labels, Label(words, further[0].first, further[-1].last)]


def read_history(path: Path) -> list[Generation]:
    """Generations that history.jsonl tells of; none when there is no such file. Its last line may be half."""
    if not path.exists():
        return []
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    return [Generation(**json.loads(line)) for line in lines if line.endswith("\n")]


def _words(stage: Stage) -> tuple[str, ...]:
    """Names of a stage, each shorter than the one before."""
    kind, _, number = stage.name.rpartition(" ")
    if kind == "level":
        return (f"{stage.name}: {f'{stage.count} GAs' if stage.count > 1 else 'the root'}", stage.name, number)
    return (stage.name, number) if kind == "start" else (stage.name,)


def _parts(stage: str) -> tuple[str, int]:
    found = _NAME.fullmatch(stage)
    return (found["name"], int(found["count"] or 1)) if found else (stage, 1)
