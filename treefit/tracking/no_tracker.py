"""NoTracker: keeps nothing; the run's own folder has everything."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from treefit.tracking.story import Story


class NoTracker:
    """Tracker that does nothing."""

    where = ""

    def start(
        self,
        name: str,
        tags: Mapping[str, str],
        params: Mapping[str, str],
        parent: str | None = None,
        folder: Path | None = None,
    ) -> None:
        """Do nothing."""

    def log(self, metrics: Mapping[str, float], step: int) -> None:
        """Do nothing."""

    def artifacts(self, folder: Path, pattern: str = "**/*") -> None:
        """Do nothing."""

    def tell(self, story: Story) -> None:
        """Do nothing."""

    def finish(self, status: str) -> None:
        """Do nothing."""

    def identity(self, seconds: float) -> str | None:  # noqa: ARG002  the protocol's signature
        """Return None: there is no run."""
        return None
