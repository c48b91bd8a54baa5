"""Tracker: where the numbers and files of a run are kept to be browsed and compared."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Protocol, runtime_checkable

from treefit.tracking.story import Story


@runtime_checkable
class Tracker(Protocol):
    """Keeps a run; never raises and never keeps the caller waiting, but for `finish`."""

    def start(
        self,
        name: str,
        tags: Mapping[str, str],
        params: Mapping[str, str],
        parent: str | None = None,
        folder: Path | None = None,
    ) -> None:
        """Begin a run, or go on with the one that `folder` is; `parent` is the identity of the run it belongs to."""

    def log(self, metrics: Mapping[str, float], step: int) -> None:
        """Keep the numbers of one generation."""

    def artifacts(self, folder: Path, pattern: str = "**/*") -> None:
        """Keep the files in `folder` that match `pattern`."""

    def tell(self, story: Story) -> None:
        """Show `story` where the run is browsed."""

    def finish(self, status: str) -> None:
        """End the run as FINISHED, FAILED or KILLED; waits a bounded time until everything is kept."""

    def identity(self, seconds: float) -> str | None:
        """Identity by which other runs name this one as their parent; waits up to `seconds` for it."""

    @property
    def where(self) -> str:
        """Words for how to browse the run, "" when there is nothing to browse."""
