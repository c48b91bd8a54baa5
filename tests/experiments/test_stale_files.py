"""Files of a generator that are of another version, or damaged, end a fit with one line and exit status 2."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from experiments.errors import WRONG_INPUT, is_input_error
from tests.family.counted import statistics
from treefit.family.identity import FamilyError, StaleError

RUN = Path(__file__).parents[2] / "run.py"
PROGRAM = f"""
import pathlib, runpy, sys
sys.path.insert(0, {str(RUN.parent)!r})
from generators.simplegen import SimpleGen
SimpleGen.family = pathlib.Path("family")
runpy.run_path({str(RUN)!r}, run_name="__main__")
"""
"""The program, with files of SimpleGen in the folder family/ from where it runs."""

STALE = ("error: statistics of generator 'simplegen' are stale: statistics.npz is of version 0, the generator of 2; "
         "renew them: python run.py task=statistics generator=simplegen statistics.renew=true")  # fmt: skip
DAMAGED = "error: guess family/guess.npz: damaged (File is not a zip file); delete the file"


def _old(folder: Path) -> None:
    statistics(version="0").write(folder / "statistics.npz")


def _damaged(folder: Path) -> None:
    statistics().write(folder / "statistics.npz")
    (folder / "guess.npz").write_bytes(b"PK\x03\x04 half of a guess")


@pytest.mark.parametrize(("write", "line"), [(_old, STALE), (_damaged, DAMAGED)])
def test_a_fit_with_files_that_cannot_be_used_ends_with_one_line(
    tmp_path: Path, write: Callable[[Path], None], line: str
) -> None:
    (tmp_path / "family").mkdir()
    write(tmp_path / "family")
    settings = ["image=pine.png", "tracking=none", "optimizer.evaluations=60", "hydra.run.dir=out"]
    done = subprocess.run([sys.executable, "-c", PROGRAM, *settings], cwd=tmp_path, capture_output=True, text=True)
    assert done.stderr.splitlines() == [line]
    assert done.returncode == WRONG_INPUT
    assert not (tmp_path / "out" / "checkpoint.npz").exists()


def test_such_errors_are_the_users_to_mend() -> None:
    assert is_input_error(FamilyError("damaged"))
    assert is_input_error(StaleError("it is old", "simplegen"))
