"""MlflowRun: one run in mlflow, called from the background thread only; the only file that imports mlflow."""

from __future__ import annotations

import logging
import os
import time
from collections.abc import Mapping
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from filelock import FileLock

from treefit.tracking.local_store import LocalStore

if TYPE_CHECKING:
    from mlflow import MlflowClient

ENVIRONMENT = {
    "MLFLOW_DISABLE_TELEMETRY": "true",
    "MLFLOW_LOGGING_LEVEL": "ERROR",
    # by default one call to a server that is down blocks for four minutes
    "MLFLOW_HTTP_REQUEST_MAX_RETRIES": "2",
    "MLFLOW_HTTP_REQUEST_TIMEOUT": "15",
}
LEFT_OUT = ("checkpoint.npz", "run.log", "job.json", "sweep.json")
"""Files of a run's folder that nobody browses."""

LONGEST_VALUE = 500


class MlflowRun:
    """Run in the local `store`, or at the address of a server."""

    def __init__(self, store: LocalStore | str, experiment: str) -> None:
        self._store, self._experiment = store, experiment
        self.run_id: str | None = None
        self.experiment_id: str | None = None

    def start(self, name: str, tags: Mapping[str, str], params: Mapping[str, str], parent: str | None) -> None:
        """Connect and begin the run."""
        for key, value in ENVIRONMENT.items():
            os.environ.setdefault(key, value)
        with self._only_one():
            self._client = self._connect()
            self.experiment_id = self._find_experiment()
        from mlflow.entities import Param

        given = dict(tags) | ({"mlflow.parentRunId": parent} if parent else {})
        run = self._client.create_run(self.experiment_id, tags=given, run_name=name)
        self.run_id = run.info.run_id
        shown = [Param(key, value[:LONGEST_VALUE]) for key, value in params.items()]
        self._client.log_batch(run.info.run_id, params=shown)

    def log(self, metrics: Mapping[str, float], step: int, when: float) -> None:
        """Keep `metrics` of one `step`, measured at `when` (s since 1970), in one batch."""
        from mlflow.entities import Metric

        batch = [Metric(key, float(value), int(when * 1000), step) for key, value in metrics.items()]
        self._client.log_batch(self._begun(), metrics=batch)

    def artifacts(self, folder: Path, pattern: str) -> None:
        """Keep the files of `folder` that match `pattern`; pictures also where mlflow shows them in a row."""
        for file in sorted(path for path in folder.glob(pattern) if path.is_file()):
            if file.name not in LEFT_OUT:
                place = file.parent.relative_to(folder).as_posix()
                self._client.log_artifact(self._begun(), str(file), None if place == "." else place)
        self._show(folder / "gallery.png", "gallery", 0)
        for rank, picture in enumerate(sorted(folder.glob("candidates/*/picture.png")), start=1):
            self._show(picture, "candidate", rank)

    def finish(self, status: str) -> None:
        """End the run."""
        if self.run_id is not None:
            self._client.set_terminated(self.run_id, status)

    def _begun(self) -> str:
        if self.run_id is None:
            raise RuntimeError("the run did not begin")
        return self.run_id

    def _show(self, picture: Path, key: str, step: int) -> None:
        from PIL import Image

        if picture.is_file():
            with Image.open(picture) as image:
                self._client.log_image(self._begun(), image.convert("RGB"), key=key, step=step, timestamp=_now())

    def _only_one(self) -> FileLock | nullcontext[None]:
        if isinstance(self._store, str):
            return nullcontext()
        self._store.lock.parent.mkdir(parents=True, exist_ok=True)
        return FileLock(self._store.lock)

    def _connect(self) -> MlflowClient:
        from mlflow import MlflowClient

        logging.getLogger("alembic").setLevel(logging.WARNING)  # tells of each table that it makes
        return MlflowClient(tracking_uri=self._store if isinstance(self._store, str) else self._store.uri)

    def _find_experiment(self) -> str:
        known = self._client.get_experiment_by_name(self._experiment)
        if known is not None:
            return str(known.experiment_id)
        place = None if isinstance(self._store, str) else self._store.artifacts
        return str(self._client.create_experiment(self._experiment, artifact_location=place))


def _now() -> int:
    return int(time.time() * 1000)
