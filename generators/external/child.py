"""Child: a program that is started once and grows one tree a request, a line of JSON each way."""

from __future__ import annotations

import json
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from generators.external.answers import Answer
from generators.external.faults import Refused
from generators.external.limits import START, Limits
from generators.external.process import Process
from generators.external.scratch import remove
from treefit.plant import Values

LOOKS = 20
"""Trees between two looks at the memory of a program that answers at once."""

FULL = 0.8
"""Part of the memory that a program may have at which, between two trees, it is replaced: leaks cost no tree."""


class Child:
    """A running program with a folder of its own; after any fault but Refused it is not to be asked again."""

    def __init__(self, command: Sequence[str], folder: Path, limits: Limits, environment: Mapping[str, str]) -> None:
        folder.mkdir(parents=True)
        self.folder, self._limits, self._asked = folder, limits, 0
        self._process = Process(command, folder, limits, environment, listens=True)

    def grow(self, values: Values, seed: int) -> Path:
        """Let it grow a tree of `values`; return the path, without its suffix, of the file that it was to write.

        Refused with its own words when it says that it cannot; another GeneratorFault when it fails.
        """
        out = self.folder / f"tree-{self._asked + 1}"
        try:
            self.ask({"values": dict(values), "seed": seed, "out": str(out)})
        except Refused:
            for file in self.folder.glob(f"{out.name}.*"):
                file.unlink(missing_ok=True)
            raise
        return out

    def ask(self, request: Mapping[str, object]) -> Answer:
        """Answer to `request`; Refused with its own words when it is not ok."""
        limit = self._limits.timeout + (0.0 if self._asked else START)
        self._asked += 1
        self._process.answers.begin()
        self._process.write(json.dumps({"id": self._id, **request}).encode() + b"\n")
        answer = self._answer(time.perf_counter() + limit)
        if answer["ok"] is not True:
            raise Refused(_one_line(answer.get("error") or "it said no reason"))
        return answer

    def end(self, patience: float = 0.0) -> None:
        """End it with its children and its folder; `patience` are seconds in which it may go by itself."""
        self._process.end(patience)
        remove(self.folder)

    def hang_up(self) -> None:
        """Tell it that nothing more comes."""
        self._process.hang_up()

    @property
    def full(self) -> bool:
        """Whether it has come to hold so much memory that a new one should take its place; looked at now and then."""
        return self._asked % LOOKS == 0 and self._process.held(with_children=False) > FULL * self._limits.memory

    @property
    def alive(self) -> bool:
        """Whether it runs."""
        return self._process.alive

    @property
    def _id(self) -> int:
        """Number of the last request: 1, 1001, ...: what a program answers ahead of a request fits none."""
        return 1 + 1000 * (self._asked - 1)

    def _answer(self, end: float) -> Answer:
        """The answer to the last request; those to earlier ones are too late."""
        while True:
            answer = self._process.wait(end - time.perf_counter())
            if answer is None:
                raise self._process.died()
            if answer["id"] == self._id and answer["id"] is not True:
                return answer


def _one_line(words: Any) -> str:
    return " ".join(str(words).split())[:500]
