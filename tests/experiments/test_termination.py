"""SIGTERM ends a run as Ctrl-C does."""

import os
import signal
import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import pytest

from experiments.termination import STOPPED, TERMINATED, Terminated, gentle, status_of
from tests.experiments.program import RUN


def end_twice(ended: list[bool]) -> None:
    """What a run goes through that is told to end, and again while it tidies up."""
    with gentle():
        try:
            os.kill(os.getpid(), signal.SIGTERM)
        finally:
            os.kill(os.getpid(), signal.SIGTERM)
            ended.append(True)


def test_the_first_sigterm_interrupts_and_another_one_disturbs_no_end() -> None:
    before, ended = signal.getsignal(signal.SIGTERM), list[bool]()
    with pytest.raises(Terminated) as caught:
        end_twice(ended)
    assert ended
    assert signal.getsignal(signal.SIGTERM) == before
    assert status_of(caught.value) == TERMINATED == 128 + signal.SIGTERM
    assert status_of(KeyboardInterrupt()) == STOPPED == 128 + signal.SIGINT


def wait_for(path: Path, process: subprocess.Popen[str]) -> None:
    end = time.monotonic() + 60
    while not path.exists():
        assert process.poll() is None
        assert time.monotonic() < end, f"{path.name} never came"
        time.sleep(0.05)


@pytest.mark.slow
def test_a_run_that_is_told_to_end_says_how_to_go_on_and_is_kept_as_killed(tmp_path: Path) -> None:
    command = [sys.executable, str(RUN), "image=pine.png", "hydra.run.dir=out", "optimizer.evaluations=1000000",
               "tracking.uri=sqlite:///runs.db", "evaluator=threads"]  # fmt: skip
    with subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        wait_for(tmp_path / "out" / "checkpoint.npz", process)
        process.terminate()
        _, said = process.communicate(timeout=30)
    assert process.returncode == TERMINATED
    assert "stopped; to go on: python run.py resume=" in said
    assert "Traceback" not in said
    with closing(sqlite3.connect(tmp_path / "runs.db")) as store:
        assert store.execute("SELECT status FROM runs").fetchall() == [("KILLED",)]
