"""The parent of the runs of a sweep in the tracking: a file in the sweep's folder says which it is."""

from __future__ import annotations

import json
from pathlib import Path

from hydra.core.hydra_config import HydraConfig

from experiments.run_folder import in_sweep

PARENT_FILE = "sweep.json"


def write_parent(folder: Path, parent: str | None) -> None:
    """Say in the sweep's `folder` which run of the tracking is the parent of all."""
    (folder / PARENT_FILE).write_text(json.dumps({"parent": parent}), encoding="utf-8")


def parent_run() -> str | None:
    """Identity of the sweep's run in the tracking; None outside of a sweep."""
    if not in_sweep():
        return None
    file = Path(HydraConfig.get().sweep.dir) / PARENT_FILE
    parent = json.loads(file.read_text(encoding="utf-8"))["parent"] if file.is_file() else None
    return None if parent is None else str(parent)
