"""The program as `python run.py` starts it, but inside the process of the tests: a start of its own takes seconds."""

from __future__ import annotations

import logging
import runpy
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

import pytest
from hydra.core.hydra_config import HydraConfig

RUN = Path(__file__).parents[2] / "run.py"


@dataclass(frozen=True)
class Done:
    """How the program ended and what it said."""

    status: int
    stdout: str
    stderr: str


def run_program(here: Path, *arguments: str) -> Done:
    """What `python run.py` with `arguments` does in the folder `here`; afterwards Hydra and logging are as before."""
    status: object = None
    with pytest.MonkeyPatch.context() as patch, _hydra_kept(), _logging_kept():
        patch.chdir(here)
        patch.setattr(sys, "argv", [str(RUN), *arguments])
        with redirect_stdout(StringIO()) as out, redirect_stderr(StringIO()) as err:
            try:
                runpy.run_path(str(RUN), run_name="__main__")
            except SystemExit as end:
                status = end.code
    return Done(status if isinstance(status, int) else int(status is not None), out.getvalue(), err.getvalue())


def finish(here: Path, *arguments: str) -> Done:
    """The same of a run that has to end well."""
    done = run_program(here, *arguments)
    assert done.status == 0, done.stderr
    return done


@contextmanager
def _hydra_kept() -> Iterator[None]:
    known = HydraConfig.instance().cfg
    yield
    HydraConfig.instance().cfg = known


@contextmanager
def _logging_kept() -> Iterator[None]:
    loggers = [logging.getLogger(), logging.getLogger("py.warnings")]
    known = [(logger, logger.handlers[:], logger.level, logger.propagate) for logger in loggers]
    yield
    for logger, handlers, level, propagate in known:
        for handler in set(logger.handlers) - set(handlers):
            handler.close()
        logger.handlers[:], logger.propagate = handlers, propagate
        logger.setLevel(level)
