"""Sweep: several runs under one parent in the tracking, and one table of their results at the end."""

from __future__ import annotations

import atexit
import sys
from collections.abc import Mapping
from pathlib import Path

from hydra.core.utils import JobReturn
from hydra.experimental.callback import Callback
from omegaconf import DictConfig, OmegaConf

from experiments.build import build
from experiments.errors import FAILED
from experiments.sweep_page import write_page
from experiments.sweep_parent import write_parent
from experiments.sweep_picture import write_picture
from experiments.sweep_story import GLANCE, numbers, sweep_story
from experiments.sweep_table import Job, SweepTable, read_jobs, tabulate
from experiments.terminal import print_sweep
from experiments.where_to_browse import where_to_browse
from treefit.tracking import NoTracker, Tracker

SECONDS_FOR_PARENT = 30.0
"""How long the sweep waits for its parent run before it goes on without one."""


class SweepCallback(Callback):
    """Hydra's callback around a sweep."""

    _tracker: Tracker = NoTracker()

    def __getstate__(self) -> Mapping[str, object]:
        """Return nothing: launchers send the callback to worker processes, where the tracker cannot go."""
        return {}

    def on_multirun_start(self, config: DictConfig, **_: object) -> None:
        """Begin the parent run and write its identity where the runs find it."""
        folder = Path(config.hydra.sweep.dir)
        folder.mkdir(parents=True, exist_ok=True)
        parent = None
        if config.task == "fit" and OmegaConf.is_dict(config.tracking) and "_target_" in config.tracking:
            self._tracker = _tracker(config.tracking)
            self._tracker.start("sweep", {"task": "sweep", "folder": folder.name}, {}, None, folder)
            parent = self._tracker.identity(SECONDS_FOR_PARENT)
            atexit.register(self._stopped, folder)
        write_parent(folder, parent)

    def on_job_end(self, config: DictConfig, job_return: JobReturn, **_: object) -> None:  # noqa: ARG002
        """Say on the parent's page how far the sweep is; runs of other processes are seen at its end."""
        if not isinstance(self._tracker, NoTracker):
            folder = Path(config.hydra.sweep.dir)
            jobs = read_jobs(folder)
            self._tell(folder, jobs, tabulate(jobs))

    def on_multirun_end(self, config: DictConfig, **_: object) -> None:
        """Write the table, end the parent run; the exit status tells whether a run failed."""
        folder = Path(config.hydra.sweep.dir)
        jobs = self._write(folder)
        failed = sum(job.status != "done" for job in jobs)
        where = where_to_browse(config.tracking, self._tracker)
        self._finish("FAILED" if failed else "FINISHED")
        print_sweep(len(jobs), failed, folder, where)
        if failed:
            sys.exit(FAILED)

    def _write(self, folder: Path) -> list[Job]:
        """Write page and picture of the sweep, and show them on the parent's page."""
        jobs = read_jobs(folder)
        table = tabulate(jobs)
        write_page(table, folder / "sweep.html")
        write_picture(table, folder / "sweep.png")
        if not isinstance(self._tracker, NoTracker):
            self._tracker.artifacts(folder, "sweep.*")
            self._tell(folder, jobs, table)
        return jobs

    def _tell(self, folder: Path, jobs: list[Job], table: SweepTable) -> None:
        self._tracker.tell(sweep_story(folder, jobs, table))
        self._tracker.artifacts(folder, GLANCE)
        self._tracker.log(numbers(jobs), len(jobs))

    def _stopped(self, folder: Path) -> None:
        """End the parent run of a sweep that was stopped: Hydra calls nothing then."""
        self._write(folder)
        self._finish("KILLED")

    def _finish(self, status: str) -> None:
        self._tracker.finish(status)
        self._tracker = NoTracker()
        atexit.unregister(self._stopped)


def _tracker(node: DictConfig) -> Tracker:
    tracker = build(node, "tracking")
    assert isinstance(tracker, Tracker)
    return tracker
