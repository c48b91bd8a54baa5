"""tracking.json: which run of which store a run's folder is, so that a resumed run goes on in the same one."""

from __future__ import annotations

import json
from pathlib import Path

FILE = "tracking.json"


def read_run(folder: Path, store: str, experiment: str) -> str | None:
    """Identity of the run that `folder` is in this `experiment` of the `store`, None when it is in none."""
    try:
        kept = json.loads((folder / FILE).read_text(encoding="utf-8"))
        return str(kept["run"]) if (kept["store"], kept["experiment"]) == (store, experiment) else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def write_run(folder: Path, store: str, experiment: str, run: str) -> None:
    """Keep it, at once or not at all."""
    unfinished = folder / f"{FILE}.tmp"
    unfinished.write_text(json.dumps({"store": store, "experiment": experiment, "run": run}) + "\n", encoding="utf-8")
    unfinished.replace(folder / FILE)


def run_of(folder: Path) -> str | None:
    """Identity of the run that `folder` is in whatever store it was kept in last."""
    try:
        return str(json.loads((folder / FILE).read_text(encoding="utf-8"))["run"])
    except (OSError, ValueError, KeyError, TypeError):
        return None
