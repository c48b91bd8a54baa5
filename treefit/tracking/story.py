"""Story: what the page of a run shows at first sight, in words that no tracker knows the addresses of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

Cell = str | float | int | Path
"""Value of a table; a Path is a picture, shown small."""

Table = Sequence[Mapping[str, Cell]]
"""Rows with the same columns."""


@dataclass(frozen=True)
class Story:
    """Of one run: `description` is HTML without blank lines; `pictures` by title are shown, `tables` by name.

    In the description pictures are files of the run's folder, src="glance.png", and links are such files or tables,
    href="candidates_table.json", or other runs, href="run:<identity>". Names from outside must be escaped.
    """

    description: str
    pictures: Mapping[str, Path] = field(default_factory=dict)
    tables: Mapping[str, Table] = field(default_factory=dict)
