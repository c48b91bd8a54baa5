"""Sweep: several runs under one parent in the tracking, and one table of their results at the end."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

from hydra.experimental.callback import Callback
from omegaconf import DictConfig, OmegaConf

from experiments.build import build
from experiments.errors import FAILED
from experiments.sweep_page import write_page
from experiments.sweep_parent import write_parent
from experiments.sweep_picture import write_picture
from experiments.sweep_table import Job, read_jobs, tabulate
from experiments.terminal import print_sweep
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
            self._tracker.start(folder.name, {"kind": "sweep"}, {}, None)
            parent = self._tracker.identity(SECONDS_FOR_PARENT)
        write_parent(folder, parent)

    def on_multirun_end(self, config: DictConfig, **_: object) -> None:
        """Write the table, end the parent run; the exit status tells whether a run failed."""
        folder = Path(config.hydra.sweep.dir)
        jobs = read_jobs(folder)
        table = tabulate(jobs)
        write_page(table, folder / "sweep.html")
        write_picture(table, folder / "sweep.png")
        failed = sum(job.status != "done" for job in jobs)
        self._finish(folder, jobs, failed)
        print_sweep(len(jobs), failed, folder, self._tracker.where)
        if failed:
            sys.exit(FAILED)

    def _finish(self, folder: Path, jobs: list[Job], failed: int) -> None:
        scores = [job.score for job in jobs if job.score is not None]
        best = {"best_score": max(scores)} if scores else {}
        self._tracker.log({"runs": len(jobs), "failed": failed, **best}, 0)
        self._tracker.artifacts(folder, "sweep.*")
        self._tracker.finish("FAILED" if failed else "FINISHED")


def _tracker(node: DictConfig) -> Tracker:
    tracker = build(node, "tracking")
    assert isinstance(tracker, Tracker)
    return tracker
