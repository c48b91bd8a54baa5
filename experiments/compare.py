"""Task compare: optimisers on the same targets at equal budgets; which is better after how many evaluations.

A run in the same folder (`hydra.run.dir=`) does only what is not kept there, so that a study may be stopped at any time
and more optimisers come later. What is kept is done anew when a setting changes, but not when the code of an optimiser
does: delete its files under `runs/` then.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import cast

from hydra.core.hydra_config import HydraConfig
from omegaconf import DictConfig

from experiments.build import build
from experiments.compare_page import page
from experiments.compare_plan import plan
from experiments.compare_plot import draw_curves
from experiments.compare_runs import Failed, Job, Run, attempt, keep, kept
from experiments.compare_study import Study, numbers
from experiments.numbers import rounded
from experiments.run_folder import run_folder
from experiments.settings import read_settings
from experiments.sweep_parent import parent_run
from experiments.write_run import write_json
from treefit.evaluation import in_parallel
from treefit.regrowth import SearchError
from treefit.tracking import Tracker

REPORT_SECONDS = 60.0
"""Seconds between two reports while searches go on."""


def run(cfg: DictConfig) -> None:
    """Do the searches that are not kept yet; write compare.md, compare.json and two plots, every minute too."""
    folder, settings = run_folder(), read_settings(cfg)
    study, jobs = plan(cfg, settings)
    tracker = cast(Tracker, build(cfg.tracking, "tracking"))
    tracker.start(folder.name, {"task": "compare"}, _params(study), parent_run())
    status = "FAILED"
    try:
        study, failed = _search(study, jobs, folder)
        if not study.runs:
            raise SearchError("compare: no search succeeded, the lines above say why")
        _write(study, folder, renew=settings.compare.renew)
        _log(study, tracker)
        status = "FINISHED"
    except KeyboardInterrupt:
        status = "KILLED"
        raise
    finally:
        tracker.artifacts(folder, "*.*")
        tracker.finish(status)
    told = {"table": str(folder / "compare.md"), "runs": len(study.runs), "failed": failed}
    print(json.dumps(told), flush=True)


def _search(study: Study, jobs: Sequence[Job], folder: Path) -> tuple[Study, int]:
    """Study with all runs, and how many failed; every run is kept at once."""
    known = [kept(job.label, job.settings, folder) for job in jobs]
    runs = [run for run in known if run is not None]
    missing = {job.label: job for job, run in zip(jobs, known, strict=True) if run is None}
    _say(f"{len(runs)} of {len(jobs)} searches are kept")
    started, failed = time.monotonic(), 0
    reported = started
    searches = in_parallel(attempt, missing.values(), study.wanted.workers, "processes", ordered=False)
    for done, found in enumerate(searches, start=1):
        left = _duration((time.monotonic() - started) / done * (len(missing) - done))
        count = f"{len(jobs) - len(missing) + done}/{len(jobs)} {found.label}"
        if isinstance(found, Failed):
            failed += 1
            _say(f"{count}: failed: {found.reason}; {left} left")
            continue
        keep(found, missing[found.label].settings, folder)
        runs.append(found)
        _say(f"{count}: {found.at(found.evaluations):.4f}, {found.seconds:.0f} s; {left} left")
        if time.monotonic() - reported >= REPORT_SECONDS:
            _write(replace(study, runs=_ordered(runs, jobs)), folder, renew=False)
            reported = time.monotonic()
    return replace(study, runs=_ordered(runs, jobs)), failed


def _ordered(runs: Sequence[Run], jobs: Sequence[Job]) -> list[Run]:
    """`runs` in the order of `jobs`: the report must not depend on which was done first."""
    by_label = {run.label: run for run in runs}
    return [by_label[job.label] for job in jobs if job.label in by_label]


def _write(study: Study, folder: Path, renew: bool) -> None:
    """Write what is known so far, to the repository too when it is to `renew` what is there."""
    given = [str(one) for one in HydraConfig.get().overrides.task]
    here = Path(__file__).parent
    for place, figures in [(folder, folder), *([(here, here / "figures")] if renew else [])]:
        files = [figures / "compare_curves.png", figures / "compare_behind.png"]
        if study.groups:
            draw_curves(study.groups, study.wanted.evaluations, files[0])
            draw_curves(study.groups, study.wanted.evaluations, files[1], behind=True)
        shown = [file.relative_to(place).as_posix() for file in files if study.groups]
        (place / "compare.md").write_text(page(study, given, shown), encoding="utf-8")
    write_json(folder / "compare.json", cast(dict[str, object], rounded(_facts(study), 5)))


def _facts(study: Study) -> dict[str, object]:
    groups = [*study.groups, *([study.whole] if study.whole else [])]
    return {group.name: {"reference": group.stronger(study.wanted.reference, study.wanted.evaluations),
                         "places": len(group.places), "optimizers": numbers(group, study.wanted)}
            for group in groups}  # fmt: skip


def _log(study: Study, tracker: Tracker) -> None:
    """Log the mean score of every optimiser on every generator, with the budget as the step."""
    for budget in study.wanted.columns:
        found = {group.name: zip(group.optimizers, group.at(budget), strict=True) for group in study.groups}
        means = {f"{group}/{name}": float(row.mean()) for group, rows in found.items() for name, row in rows}
        tracker.log(means, budget)


def _params(study: Study) -> dict[str, str]:
    wanted = study.wanted
    return {
        "generators": ", ".join(wanted.generators), "optimizers": ", ".join(study.recipes), "seed": str(study.seed),
        "evaluations": str(wanted.evaluations), "repeats": str(wanted.repeats),
    }  # fmt: skip


def _duration(seconds: float) -> str:
    minutes = round(seconds / 60)
    return (
        f"{minutes // 60} h {minutes % 60} min"
        if minutes >= 60
        else f"{minutes} min"
        if minutes
        else f"{seconds:.0f} s"
    )


def _say(line: str) -> None:
    print(line, file=sys.stderr, flush=True)
