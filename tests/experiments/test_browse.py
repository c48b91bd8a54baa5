import signal
import sys
from pathlib import Path

import pytest

from experiments import browse
from tests.experiments.program import run_program


@pytest.mark.parametrize(
    ("settings", "line"),
    [
        ((), "browse: no runs are kept in"),
        (("tracking=none",), "browse: tracking=none keeps no runs"),
        (("tracking.uri=http://127.0.0.1:9",), "tracking.uri: no mlflow server answers at http://127.0.0.1:9"),
        (("browse.port=0",), "browse.port: must be greater than or equal to 1, got 0"),
        (("browse.open=perhaps",), "browse.open"),
    ],
)
def test_what_cannot_be_browsed_is_said_in_one_line(tmp_path: Path, settings: tuple[str, ...], line: str) -> None:
    done = run_program(tmp_path, "task=browse", *settings)
    assert done.status == 2
    assert done.stderr.count("\n") == 1
    assert line in done.stderr
    assert not list(tmp_path.iterdir())


def test_ctrl_c_ends_the_pages_with_status_zero_and_leaves_no_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Pages:
        address = "http://127.0.0.1:1"

        def __init__(self, *_: object) -> None:
            self.ended = False
            made.append(self)

        def __enter__(self) -> "Pages":
            return self

        def __exit__(self, *_: object) -> None:
            self.ended = True

        def wait(self) -> int:
            raise KeyboardInterrupt

    made: list[Pages] = []
    opened: list[str] = []
    monkeypatch.setattr(browse, "Server", Pages)
    monkeypatch.setattr(browse, "find_runs_page", lambda address, experiment: f"{address}/#/{experiment}")
    monkeypatch.setattr(browse.webbrowser, "open", opened.append)
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    (tmp_path / "m.db").touch()
    done = run_program(tmp_path, "task=browse", f"tracking.uri=sqlite:///{tmp_path}/m.db", "browse.open=true")
    assert (done.status, done.stdout) == (0, "runs     http://127.0.0.1:1/#/treefit\n")
    assert opened == ["http://127.0.0.1:1/#/treefit"]
    assert made[0].ended
    assert [path.name for path in tmp_path.iterdir()] == ["m.db"]


@pytest.mark.skipif(
    sys.platform in ("win32", "darwin"), reason="these have a display unless one is logged in from afar"
)
def test_browser_is_opened_by_itself_only_where_there_is_a_display(monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []
    monkeypatch.setattr(browse.webbrowser, "open", opened.append)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    for display in ("", ":0"):
        monkeypatch.setenv("DISPLAY", display)
        browse._show("page", browse.BrowseSettings())
    assert opened == ["page"]
