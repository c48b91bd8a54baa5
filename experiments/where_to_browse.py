"""The line at the end of a run that says how to look at it beside all others."""

from __future__ import annotations

import shlex
from typing import cast

from omegaconf import DictConfig, OmegaConf

from experiments.command_check import CONFIG_FOLDER
from treefit.tracking import Tracker
from treefit.tracking.local_store import LocalStore, find_store


def where_to_browse(tracking: DictConfig, tracker: Tracker) -> str:
    """Command that shows the runs kept by the group `tracking`, or the page of its server; "" when none are kept."""
    if "uri" not in tracking:
        return tracker.where
    if not isinstance(find_store(tracking.uri), LocalStore):
        return tracker.where
    usual = cast(DictConfig, OmegaConf.load(CONFIG_FOLDER / "tracking" / "mlflow.yaml"))
    changed = [f"tracking.{name}={tracking[name]}" for name in ("uri", "experiment") if tracking[name] != usual[name]]
    return " ".join(["python run.py task=browse", *map(shlex.quote, changed)])
