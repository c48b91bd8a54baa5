"""MlflowRun: one run in mlflow, called from the background thread only; the only file that imports mlflow."""

from __future__ import annotations

import json
import logging
import os
import time
from collections.abc import Mapping
from contextlib import nullcontext
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from filelock import FileLock

from treefit.tracking.addresses import VIEW_TAG, address, view
from treefit.tracking.kept_run import FILE, read_run, write_run
from treefit.tracking.local_store import LocalStore
from treefit.tracking.machine import Machine
from treefit.tracking.story import Story, Table
from treefit.tracking.table import on_white, write_table

if TYPE_CHECKING:
    from mlflow import MlflowClient

ENVIRONMENT = {
    "MLFLOW_DISABLE_TELEMETRY": "true",
    "MLFLOW_LOGGING_LEVEL": "ERROR",
    # by default one call to a server that is down blocks for four minutes
    "MLFLOW_HTTP_REQUEST_MAX_RETRIES": "2",
    "MLFLOW_HTTP_REQUEST_TIMEOUT": "15",
}
LEFT_OUT = ("checkpoint.npz", "run.log", "job.json", "sweep.json", "live.js", FILE)
"""Files of a run's folder that nobody browses."""

LONGEST_VALUE = 500
TABLES_TAG = "mlflow.loggedArtifacts"
"""Tag of a run that says which of its files are tables."""


class MlflowRun:
    """Run in the local `store`, or at the address of a server."""

    def __init__(self, store: LocalStore | str, experiment: str) -> None:
        self._store, self._experiment = store, experiment
        self._last_step = -1
        self.run_id: str | None = None
        self.experiment_id: str | None = None

    def start(
        self,
        name: str,
        tags: Mapping[str, str],
        params: Mapping[str, str],
        parent: str | None,
        folder: Path | None,
        when: float,
    ) -> None:
        """Connect and begin the run at `when` (s since 1970), or go on with the one that `folder` is already."""
        for key, value in ENVIRONMENT.items():
            os.environ.setdefault(key, value)
        with self._only_one():
            self._client = self._connect()
            self.experiment_id = self._find_experiment()
        if folder is not None and self._go_on(folder):
            return
        from mlflow.entities import Param

        given = dict(tags) | ({"mlflow.parentRunId": parent} if parent else {})
        run = self._client.create_run(self.experiment_id, int(when * 1000), given, run_name=name)
        self.run_id = run.info.run_id
        if folder is not None:
            write_run(folder, self._address, self._experiment, run.info.run_id)
        shown = [Param(key, value[:LONGEST_VALUE]) for key, value in params.items()]
        self._client.log_batch(run.info.run_id, params=shown)
        self._machine = Machine()

    def log(self, metrics: Mapping[str, float], step: int, when: float) -> None:
        """Keep `metrics` of one `step`, measured at `when` (s since 1970), in one batch, with the machine's load."""
        from mlflow.entities import Metric

        if 0 < step <= self._last_step:  # a resumed run tells again what it told before it was killed
            return
        known = {**metrics, **self._machine.sample()}
        batch = [Metric(key, float(value), int(when * 1000), step) for key, value in known.items()]
        self._client.log_batch(self._begun(), metrics=batch)

    def artifacts(self, folder: Path, pattern: str) -> None:
        """Keep the files of `folder` that match `pattern`."""
        for file in sorted(path for path in folder.glob(pattern) if path.is_file()):
            if file.name not in LEFT_OUT:
                self._keep(file, folder)

    def tell(self, story: Story) -> None:
        """Show `story` on the run's page."""
        run, experiment = self._begun(), self.experiment_id
        self._client.set_tag(run, "mlflow.note.content", address(story.description, str(experiment), run))
        for title, picture in story.pictures.items():
            self._show(picture, title)
        for name, table in story.tables.items():
            self._keep_table(name, table)

    def finish(self, status: str) -> None:
        """End the run."""
        if self.run_id is not None:
            self._client.set_terminated(self.run_id, status)

    def _go_on(self, folder: Path) -> bool:
        """Whether `folder` is a run of this store already, which is then running again."""
        from mlflow.exceptions import MlflowException

        known = read_run(folder, self._address, self._experiment)
        if known is None:
            return False
        try:
            if self._client.get_run(known).info.lifecycle_stage != "active":
                return False
            history = self._client.get_metric_history(known, "score")
        except MlflowException:
            return False
        self._client.update_run(known, status="RUNNING")
        self.run_id = known
        self._last_step = max((metric.step for metric in history), default=-1)
        self._machine = Machine()
        return True

    @property
    def _address(self) -> str:
        return self._store if isinstance(self._store, str) else self._store.uri

    def _keep(self, file: Path, folder: Path) -> None:
        place = file.parent.relative_to(folder).as_posix()
        self._client.log_artifact(self._begun(), str(file), None if place == "." else place)

    def _keep_table(self, name: str, table: Table) -> None:
        with TemporaryDirectory() as scratch:
            for file in write_table(Path(scratch), name, table):
                self._keep(file, Path(scratch))
        run = self._client.get_run(self._begun())
        known = json.loads(run.data.tags.get(TABLES_TAG, "[]"))
        entry = {"path": f"{name}.json", "type": "table"}
        if entry not in known:
            self._client.set_tag(self._begun(), TABLES_TAG, json.dumps([*known, entry]))

    def _begun(self) -> str:
        if self.run_id is None:
            raise RuntimeError("the run did not begin")
        return self.run_id

    def _show(self, picture: Path, title: str) -> None:
        from PIL import Image

        if picture.is_file():
            with Image.open(picture) as image:
                self._client.log_image(self._begun(), on_white(image), key=title, step=0, timestamp=_now())

    def _only_one(self) -> FileLock | nullcontext[None]:
        if isinstance(self._store, str):
            return nullcontext()
        self._store.lock.parent.mkdir(parents=True, exist_ok=True)
        return FileLock(self._store.lock)

    def _connect(self) -> MlflowClient:
        from mlflow import MlflowClient

        logging.getLogger("alembic").setLevel(logging.WARNING)  # tells of each table that it makes
        return MlflowClient(tracking_uri=self._address)

    def _find_experiment(self) -> str:
        known = self._client.get_experiment_by_name(self._experiment)
        if known is not None:
            if known.tags.get(VIEW_TAG) != view():
                self._client.set_experiment_tag(known.experiment_id, VIEW_TAG, view())
            return str(known.experiment_id)
        place = None if isinstance(self._store, str) else self._store.artifacts
        tags = {VIEW_TAG: view()}
        return str(self._client.create_experiment(self._experiment, artifact_location=place, tags=tags))


def _now() -> int:
    return int(time.time() * 1000)
