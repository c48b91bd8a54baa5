"""MlflowTracker: keeps runs in mlflow from a thread of its own: the search neither waits nor fails for it."""

from __future__ import annotations

import logging
import math
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from threading import Event

from treefit.tracking.addresses import LOCAL_ADDRESS, runs_page
from treefit.tracking.background import Background
from treefit.tracking.local_store import LocalStore, find_store
from treefit.tracking.mlflow_run import MlflowRun
from treefit.tracking.story import Story

_log = logging.getLogger(__name__)


class MlflowTracker:
    """Tracker in the mlflow store at `uri`; None: outputs/mlflow.db under the current folder.

    Runs are grouped under the name `experiment`; `finish` waits `patience` seconds at the longest.
    """

    def __init__(self, uri: str | None = None, experiment: str = "treefit", patience: float = 60.0) -> None:
        if not isinstance(experiment, str) or not experiment.strip():
            raise ValueError(f"tracking.experiment: must be a name, got {experiment!r}")
        if isinstance(patience, bool) or not isinstance(patience, int | float) or not 0 < patience < math.inf:
            raise ValueError(f"tracking.patience: must be a number of seconds greater than 0, got {patience!r}")
        self._store = find_store(uri)
        self._patience = patience
        self._run = MlflowRun(self._store, experiment)
        self._started = Event()
        self._background: Background | None = None

    def start(
        self,
        name: str,
        tags: Mapping[str, str],
        params: Mapping[str, str],
        parent: str | None = None,
        folder: Path | None = None,
    ) -> None:
        """Begin a run, or go on with the one that `folder` is already; returns at once."""
        when = time.time()
        self._background = Background("tracking", self._give_up)
        self._background.do(lambda: self._run.start(name, dict(tags), dict(params), parent, folder, when))
        self._background.do(self._started.set, always=True)

    def log(self, metrics: Mapping[str, float], step: int) -> None:
        """Keep `metrics` of generation `step` as one batch; returns at once."""
        batch, when = dict(metrics), time.time()
        self._do(lambda: self._run.log(batch, step, when))

    def artifacts(self, folder: Path, pattern: str = "**/*") -> None:
        """Keep the files in `folder` that match `pattern`; returns at once, so they must stay as they are."""
        self._do(lambda: self._run.artifacts(folder, pattern))

    def tell(self, story: Story) -> None:
        """Show `story` on the run's page; returns at once, so its pictures must stay as they are."""
        self._do(lambda: self._run.tell(story))

    def finish(self, status: str) -> None:
        """End the run and wait until it is kept, but not longer than the patience."""
        if self._background is None:
            return
        self._background.do(lambda: self._run.finish(status), always=True)
        if not self._background.close(self._patience):
            _log.warning("tracking: not done after %.0f s, left behind; the run's folder is complete", self._patience)
        self._background = None

    def identity(self, seconds: float) -> str | None:
        """Identity of the run in mlflow; None when it is not known within `seconds`."""
        self._started.wait(seconds)
        return self._run.run_id

    @property
    def where(self) -> str:
        """Command and address that show the runs; "" before the store answered."""
        if self._run.experiment_id is None:
            return ""
        page = runs_page(self._run.experiment_id)
        if isinstance(self._store, LocalStore):
            return f"{self._store.command}   then open {LOCAL_ADDRESS}/{page}"
        return f"{self._store.rstrip('/')}/{page}"

    def _do(self, job: Callable[[], None]) -> None:
        if self._background is not None:
            self._background.do(job)

    def _give_up(self, error: Exception) -> None:
        reason = " ".join(str(error).split())[:200] or type(error).__name__
        _log.warning("tracking: stopped, the run goes on and its own folder is complete (%s)", reason)
