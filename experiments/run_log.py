"""Log of a search: history.jsonl, a line a generation, and failures.jsonl, a line a candidate that failed."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from pathlib import Path

from treefit.progress import Failure, Generation

MOST_FAILURES = 1000
"""Lines of failures.jsonl; the counts in summary.json go on."""


class RunLog:
    """Appends to the logs in `folder`; what a killed run wrote after its last checkpoint is written anew."""

    def __init__(self, folder: Path) -> None:
        self.history, self.failed = folder / "history.jsonl", folder / "failures.jsonl"
        self.failures = -1  # lines of failures.jsonl; unknown before the first generation

    def write(self, generation: Generation, failures: list[Failure]) -> None:
        """Append one generation and what failed in it."""
        if self.failures < 0:
            _keep(self.history, "number", generation.number)
            self.failures = _keep(self.failed, "generation", generation.number)
        _append(self.history, [asdict(generation)])
        self._append_failures(generation.number, failures)

    def left_out(self, number: int, failure: Failure) -> None:
        """Append what failed after `number` generations, when a tree was to be grown again."""
        if self.failures < 0:
            self.failures = _keep(self.failed, "generation", number)
        self._append_failures(number, [failure])

    def _append_failures(self, number: int, failures: list[Failure]) -> None:
        new = failures[: max(MOST_FAILURES - self.failures, 0)]
        self.failures += len(new)
        if new:
            _append(self.failed, ({"generation": number, **asdict(failure)} for failure in new))


def _keep(path: Path, key: str, before: int) -> int:
    """Keep the whole lines of `path` whose `key` is below `before`; return their count."""
    if not path.exists():
        return 0
    lines = [line for line in path.read_text(encoding="utf-8").splitlines(keepends=True) if line.endswith("\n")]
    kept = [line for line in lines if json.loads(line)[key] < before]
    path.write_text("".join(kept), encoding="utf-8")
    return len(kept)


def _append(path: Path, lines: Iterable[Mapping[str, object]]) -> None:
    with path.open("a", encoding="utf-8") as file:
        file.writelines(json.dumps(line) + "\n" for line in lines)
