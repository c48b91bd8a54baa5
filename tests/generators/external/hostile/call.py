"""Call: one request, the tree that would be right, and how it would be handed over."""

import json
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np


class Call(NamedTuple):
    """What a way to misbehave gets."""

    id: int
    file: Path
    tree: dict[str, np.ndarray]

    @property
    def line(self) -> str:
        """The right answer."""
        return json.dumps({"id": self.id, "ok": True}) + "\n"

    def write(self, arrays: dict[str, np.ndarray]) -> None:
        """Write `arrays` where the tree is wanted."""
        np.savez(self.file, **arrays)

    def answer(self, line: str | None = None) -> None:
        """Print `line`, else the right answer."""
        sys.stdout.write(line or self.line)
        sys.stdout.flush()

    def say(self, **told: object) -> None:
        """Print an answer that tells so."""
        self.answer(json.dumps({"id": self.id, **told}) + "\n")

    def give(self, **changed: np.ndarray | None) -> None:
        """Hand over the tree with some arrays changed, or left out for None, as if it were right."""
        arrays = {**self.tree, **changed}
        self.write({name: array for name, array in arrays.items() if array is not None})
        self.answer()
