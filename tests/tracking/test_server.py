import sys
import time
from pathlib import Path
from urllib.request import urlopen

import psutil
import pytest

from treefit.tracking import server
from treefit.tracking.local_store import LocalStore
from treefit.tracking.server import Server, ServerError, find_runs_page, free_port

STAND_IN = """
import http.server, json, subprocess, sys
child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
class Pages(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        known = "health" in self.path or "experiment_name=a%20b" in self.path
        self.send_response(200 if known else 404)
        self.end_headers()
        self.wfile.write(json.dumps({"experiment": {"experiment_id": "7"}, "child": child.pid}).encode())
    def log_message(self, *words): pass
http.server.HTTPServer(("127.0.0.1", int(sys.argv[1])), Pages).serve_forever()
"""
"""Answers as mlflow does where it matters, with a process of its own as mlflow has; mlflow itself takes seconds."""


@pytest.fixture(autouse=True)
def _stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "server_command", lambda _, port: [sys.executable, "-c", STAND_IN, str(port)])


def test_server_answers_and_ends_with_all_its_processes(tmp_path: Path) -> None:
    with Server(LocalStore(tmp_path / "m.db"), tmp_path / "log") as pages:
        with urlopen(f"{pages.address}/health") as answer:
            child = int(answer.read().split(b'"child": ')[1].rstrip(b"}"))
        assert psutil.pid_exists(child)
        found = find_runs_page(pages.address, "a b")
        assert found is not None
        assert found.startswith(f"{pages.address}/#/experiments/7/runs?workflowType=machine_learning")
        assert find_runs_page(pages.address, "other") is None
    end = time.monotonic() + 10
    while psutil.pid_exists(child) and psutil.Process(child).status() != psutil.STATUS_ZOMBIE:
        assert time.monotonic() < end
        time.sleep(0.02)
    with pytest.raises(ServerError, match="no mlflow server answers at"):
        find_runs_page(pages.address, "a b")


def test_server_that_ends_at_once_says_why(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = [sys.executable, "-c", "import sys; sys.exit('port in use')"]
    monkeypatch.setattr(server, "server_command", lambda *_: program)
    with (
        pytest.raises(ServerError, match="the server ended: port in use"),
        Server(LocalStore(tmp_path), tmp_path / "log"),
    ):
        pass


def test_pages_are_those_of_the_store_on_a_port_that_is_free(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    store = LocalStore(tmp_path / "m.db")
    command = server.server_command(store, free_port())
    assert store.uri in command
    assert store.artifacts in command
    assert command[command.index("--host") + 1] == "127.0.0.1"
