"""Server: mlflow's pages of a local store on a free port of this machine, for as long as somebody looks."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import time
from pathlib import Path
from types import TracebackType
from urllib.error import HTTPError, URLError
from urllib.parse import quote
from urllib.request import urlopen

import psutil

from treefit.tracking.addresses import runs_page
from treefit.tracking.local_store import LocalStore

HOST = "127.0.0.1"
SECONDS = 90.0
"""How long the server may take to answer: a store of an older mlflow is brought up to date first."""

QUIET = {"MLFLOW_DISABLE_TELEMETRY": "true", "MLFLOW_SERVER_ENABLE_JOB_EXECUTION": "false"}
"""No telemetry, and none of the ten processes that judge language models."""


class ServerError(RuntimeError):
    """The server ended or did not answer."""


class Server:
    """Pages of `store` at `address`; the port is `port`, a free one when None. Use in `with`."""

    def __init__(self, store: LocalStore, log: Path, port: int | None = None) -> None:
        self._store, self._log = store, log
        self._port = port or free_port()

    @property
    def address(self) -> str:
        """Where it answers."""
        return f"http://{HOST}:{self._port}"

    def __enter__(self) -> Server:
        """Start it and wait until it answers."""
        with self._log.open("wb") as log:
            # a session of its own: Ctrl-C reaches only us, and we end all of its processes
            self._process = subprocess.Popen(
                server_command(self._store, self._port), stdout=log, stderr=log, stdin=subprocess.DEVNULL,
                env=os.environ | QUIET, start_new_session=True,
            )  # fmt: skip
        try:
            self._wait_for_answer()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def wait(self) -> int:
        """Wait until it ends by itself; return its exit status."""
        return self._process.wait()

    def stop(self) -> None:
        """End it with all its processes."""
        try:
            whole = psutil.Process(self._process.pid)
            processes = [whole, *whole.children(recursive=True)]
        except psutil.NoSuchProcess:
            return
        for process in processes:
            _signal(process, hard=False)
        for process in psutil.wait_procs(processes, timeout=5)[1]:
            _signal(process, hard=True)
        self._process.wait()

    def _wait_for_answer(self) -> None:
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            if self._process.poll() is not None:
                raise ServerError(f"the server ended: {_last_line(self._log)} (all it said: {self._log})")
            try:
                with urlopen(f"{self.address}/health", timeout=2):
                    return
            except (URLError, OSError):
                time.sleep(0.1)
        raise ServerError(f"the server did not answer within {SECONDS:.0f} s (what it said: {self._log})")


def server_command(store: LocalStore, port: int) -> list[str]:
    """Program and arguments that serve the pages of `store`."""
    return [
        sys.executable, "-m", "mlflow", "server", "--host", HOST, "--port", str(port), "--workers", "1",
        "--backend-store-uri", store.uri, "--artifacts-destination", store.artifacts,
    ]  # fmt: skip


def find_runs_page(address: str, experiment: str) -> str | None:
    """Address of the page with the runs of `experiment` at a server's `address`; None when there are none yet."""
    name = quote(experiment, safe="")
    query = f"{address.rstrip('/')}/api/2.0/mlflow/experiments/get-by-name?experiment_name={name}"
    try:
        with urlopen(query, timeout=15) as answer:
            found = json.load(answer)["experiment"]
    except HTTPError as error:
        if error.code == 404:
            return None
        raise ServerError(f"{address} answers {error.code} {error.reason}") from error
    except (OSError, ValueError, KeyError) as error:
        raise ServerError(f"no mlflow server answers at {address} ({error})") from error
    return f"{address.rstrip('/')}/{runs_page(str(found['experiment_id']))}"


def free_port() -> int:
    """Return a port of this machine that nobody listens on."""
    with socket.socket() as probe:
        probe.bind((HOST, 0))
        return int(probe.getsockname()[1])


def _signal(process: psutil.Process, hard: bool) -> None:
    try:
        if hard:
            process.kill()
        else:
            process.terminate()
    except psutil.NoSuchProcess:
        pass


def _last_line(file: Path) -> str:
    lines = file.read_text(encoding="utf-8", errors="replace").split("\n")
    return next((line.strip() for line in reversed(lines) if line.strip()), "it said nothing")
