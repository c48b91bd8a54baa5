"""Files of a generator that are of another version, or damaged, end a fit with one line and exit status 2."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from experiments.errors import WRONG_INPUT, is_input_error
from generators.simplegen import SimpleGen
from tests.experiments.program import run_program
from tests.family.counted import statistics
from treefit.family.identity import FamilyError, StaleError

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
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, write: Callable[[Path], None], line: str
) -> None:
    monkeypatch.setattr(SimpleGen, "family", Path("family"))
    (tmp_path / "family").mkdir()
    write(tmp_path / "family")
    settings = ["image=pine.png", "tracking=none", "optimizer.evaluations=60", "hydra.run.dir=out"]
    done = run_program(tmp_path, *settings)
    assert done.stderr.splitlines() == [line]
    assert done.status == WRONG_INPUT
    assert not (tmp_path / "out" / "checkpoint.npz").exists()


def test_such_errors_are_the_users_to_mend() -> None:
    assert is_input_error(FamilyError("damaged"))
    assert is_input_error(StaleError("it is old", "simplegen"))
