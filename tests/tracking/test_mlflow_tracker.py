import logging
import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image

from treefit.tracking import MlflowTracker, NoTracker, Story, Tracker
from treefit.tracking.addresses import VIEW_TAG, address, view
from treefit.tracking.kept_run import run_of
from treefit.tracking.local_store import LocalStore


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder in which the tests of this file share one database: to make it takes seconds."""
    return tmp_path_factory.mktemp("a store")


def test_runs_are_kept_with_numbers_files_and_parent(store: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(store)
    folder = store / "run"
    (folder / "candidates" / "1").mkdir(parents=True)
    for name in ("gallery.png", "candidates/1/picture.png"):
        Image.new("RGBA", (8, 8)).save(folder / name)
    for name in ("summary.json", "checkpoint.npz"):
        (folder / name).write_text("{}")
    parent, child = MlflowTracker(), MlflowTracker()
    parent.start("sweep", {}, {}, None)
    child.start("run", {"image": "pine.png"}, {"seed": "1"}, parent.identity(60))
    for step in range(3):
        child.log({"best": step / 10, "failures": float("nan")}, step)
    child.artifacts(folder)
    rows = [{"score": 0.5, "picture": folder / "gallery.png"}]
    child.tell(Story('<a href="gallery.png">see</a>', {"trees/gallery": folder / "gallery.png"}, {"trees": rows}))
    child.finish("FINISHED")
    parent.finish("FAILED")
    assert "#/experiments/1/runs?workflowType=machine_learning&viewStateShareKey=treefit" in child.where
    assert f"'sqlite:///{store.as_posix()}/outputs/mlflow.db'" in child.where

    from mlflow import MlflowClient

    client = MlflowClient(f"sqlite:///{store}/outputs/mlflow.db")
    run = client.get_run(child.identity(0))
    assert run.info.status == "FINISHED"
    assert run.data.params == {"seed": "1"}
    assert run.data.tags["image"] == "pine.png"
    assert run.data.tags["mlflow.parentRunId"] == parent.identity(0)
    assert [metric.value for metric in client.get_metric_history(run.info.run_id, "best")] == [0.0, 0.1, 0.2]
    assert client.get_run(parent.identity(0)).info.status == "FAILED"
    names = {path.path for path in client.list_artifacts(run.info.run_id)}
    assert names == {"candidates", "gallery.png", "images", "summary.json", "table_images", "trees.json"}
    assert run.data.tags["mlflow.note.content"] == address('<a href="gallery.png">see</a>', "1", run.info.run_id)
    assert run.data.tags["mlflow.loggedArtifacts"] == '[{"path": "trees.json", "type": "table"}]'
    assert client.get_experiment("1").tags[VIEW_TAG] == view()
    assert not list(store.glob("mlruns"))


def test_resumed_run_goes_on_in_the_same_run_and_tells_no_step_twice(store: Path, tmp_path: Path) -> None:
    uri = f"sqlite:///{store}/outputs/mlflow.db"
    identities = []
    for steps, status in ((range(1, 4), "KILLED"), (range(2, 6), "FINISHED")):
        tracker = MlflowTracker(uri)
        tracker.start("run", {}, {"seed": "1"}, folder=tmp_path)
        for step in steps:
            tracker.log({"score": step / 10}, step)
        identities.append(tracker.identity(60))
        tracker.finish(status)
    assert identities[0] == identities[1] == run_of(tmp_path)

    from mlflow import MlflowClient

    client = MlflowClient(uri)
    assert client.get_run(identities[0]).info.status == "FINISHED"
    assert [metric.step for metric in client.get_metric_history(identities[0], "score")] == [1, 2, 3, 4, 5]
    client.delete_run(identities[0])
    tracker = MlflowTracker(uri)
    tracker.start("run", {}, {}, folder=tmp_path)
    assert tracker.identity(60) not in (None, identities[0])
    tracker.finish("FINISHED")


def test_server_that_is_down_is_said_once_and_keeps_nobody_waiting(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MLFLOW_HTTP_REQUEST_MAX_RETRIES", "0")
    tracker = MlflowTracker(uri="http://127.0.0.1:9", patience=20)
    with caplog.at_level(logging.WARNING, logger="treefit"):
        tracker.start("run", {}, {}, None)
        for step in range(1000):
            tracker.log({"best": 1.0}, step)
        tracker.finish("FINISHED")
    said = [record.getMessage() for record in caplog.records if record.name.startswith("treefit")]
    assert len(said) == 1
    assert said[0].startswith("tracking: stopped, the run goes on and its own folder is complete")
    assert tracker.where == ""
    assert tracker.identity(0) is None


@pytest.mark.parametrize(
    ("settings", "line"),
    [
        ({"uri": "nonsense"}, "tracking.uri: must be like"),
        ({"experiment": " "}, "tracking.experiment: must be a name"),
        ({"patience": 0}, "tracking.patience: must be a number of seconds greater than 0, got 0"),
    ],
)
def test_wrong_settings_are_refused(settings: dict[str, object], line: str) -> None:
    with pytest.raises(ValueError, match=line):
        MlflowTracker(**settings)


def test_files_lie_beside_the_database_wherever_it_is(tmp_path: Path) -> None:
    store = LocalStore(tmp_path / "my.db")
    assert store.uri == f"sqlite:///{tmp_path}/my.db"
    assert store.artifacts == f"file://{tmp_path}/mlartifacts"
    assert store.lock == tmp_path / "my.db.lock"


def test_tracker_that_never_started_can_finish() -> None:
    MlflowTracker().finish("FINISHED")


def test_trackers_keep_the_protocol() -> None:
    assert isinstance(NoTracker(), Tracker)
    assert isinstance(MlflowTracker(), Tracker)
    assert NoTracker().identity(0) is None


def test_no_tracking_imports_no_mlflow() -> None:
    program = (
        "import sys; from treefit.tracking import NoTracker, MlflowTracker; t = NoTracker(); MlflowTracker();"
        "t.start('', {}, {}, None); t.log({}, 0); t.finish(''); sys.exit('mlflow' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0
