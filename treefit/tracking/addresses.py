"""Addresses of mlflow's pages: the list of runs with its columns, a run, a file of a run."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from html import escape, unescape
from urllib.parse import quote

LOCAL_ADDRESS = "http://127.0.0.1:5000"
"""Where `mlflow ui` answers by default."""

MODE = "workflowType=machine_learning"
"""Without it pages open among those for language models."""

VIEW = "treefit"
"""Name under which the columns of the list of runs are shared."""

VIEW_TAG = f"mlflow.sharedViewState.{VIEW}"
"""Tag of an experiment that mlflow's pages read shared columns from."""

COLUMNS: Mapping[str, int] = {
    "tags.`image`": 100,
    "tags.`generator`": 95,
    "metrics.`score`": 75,
    "metrics.`score_other_seeds`": 130,
    "metrics.`silhouette_iou`": 100,
    "metrics.`class_iou`": 80,
    "params.`evaluations`": 90,
}
"""Columns of the list of runs beside name, time and duration, in their order, with their width in pixels."""

_TARGET = re.compile(r'(?P<kind>href|src)="(?P<target>[^"]*)"')


def view() -> str:
    """Value of the tag VIEW_TAG: the list of runs with COLUMNS, newest first."""
    order = ["attributes.`Run Name`", "runDateAndNestInfo", *COLUMNS, "duration"]
    return json.dumps(
        {"selectedColumns": [*COLUMNS], "columnOrder": order, "columnWidths": dict(COLUMNS),
         "orderByKey": "attributes.start_time", "orderByAsc": False}
    )  # fmt: skip


def runs_page(experiment_id: str) -> str:
    """Page, after the server's address, that lists the runs with their pictures, scores and settings."""
    return f"#/experiments/{experiment_id}/runs?{MODE}&viewStateShareKey={VIEW}"


def run_page(experiment_id: str, run_id: str) -> str:
    """Page of one run."""
    return f"#/experiments/{experiment_id}/runs/{run_id}?{MODE}"


def file_page(experiment_id: str, run_id: str, file: str) -> str:
    """Page of a run that shows one of its files."""
    return f"#/experiments/{experiment_id}/runs/{run_id}/artifacts/{quote(file)}?{MODE}"


def address(description: str, experiment_id: str, run_id: str) -> str:
    """Return the `description` of a Story with its files and runs as mlflow's pages and pictures."""

    def replace(match: re.Match[str]) -> str:
        target = unescape(match["target"])
        if match["kind"] == "src":
            found = f"get-artifact?path={quote(target)}&run_uuid={run_id}"
        elif target.startswith("run:"):
            found = run_page(experiment_id, quote(target.removeprefix("run:")))
        else:
            found = file_page(experiment_id, run_id, target)
        return f'{match["kind"]}="{escape(found)}"'

    return _TARGET.sub(replace, description)
