"""A room to meet hostile programs in: a generator that misbehaves on demand, and a look at what is left behind."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
import time
import uuid
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

import psutil
import pytest
from _pytest.mark import ParameterSet

from generators.external import External
from generators.external.space import read_space
from treefit.plant import Budget, Parameter, ParameterSpace, Plant

HERE = Path(__file__).parent
PROGRAM = HERE / "tree_program.py"
SPACE = HERE / "hostile" / "space.yaml"
COMMAND = [sys.executable, str(PROGRAM)]
FLAT = 100 << 20
"""Bytes that this process may take while it deals with a hostile program: one flood or one 10^8 would be more."""

Fault = tuple[str, str] | None
"""Patterns of the name of the fault of its message; None where a tree comes nevertheless."""


@dataclass(frozen=True)
class Room:
    generator: External
    folder: Path
    mark: str

    def grow(self, how: str = "well", seed: int = 7) -> Plant:
        values = self.generator.space.complete({"how": how})
        return self.generator(values, seed, Budget())

    def meet(self, how: str, fault: Fault) -> None:
        """A call that goes wrong ends in time with `fault`, takes no memory here, and the next call is well."""
        before, start = peak_memory(), time.perf_counter()
        if fault is None:
            assert self.grow(how).n_vertices == 212
        else:
            with pytest.raises(RuntimeError, match=fault[1]) as raised:
                self.grow(how)
            assert re.fullmatch(fault[0], type(raised.value).__name__)
            assert "\n" not in str(raised.value)
            assert len(str(raised.value)) < 600
        assert time.perf_counter() - start < self.generator.limits.timeout + 2
        assert peak_memory() - before < FLAT
        assert self.grow().n_vertices == 212
        assert not (self.folder / "unpickled").exists()

    def processes(self, *, with_guard: bool = False) -> list[psutil.Process]:
        """Processes that come from here, except this one, those that are dead, and the guard over all others."""
        found = []
        for process in psutil.process_iter():
            with suppress(psutil.Error):
                living = process.pid != os.getpid() and process.status() != psutil.STATUS_ZOMBIE
                living &= with_guard or not any(part.endswith("guard.py") for part in process.cmdline())
                if living and process.environ().get("HOSTILE_ROOM") == self.mark:
                    found.append(process)
        return found

    def zombies(self) -> list[psutil.Process]:
        """Dead children of this process that nobody has looked after."""
        return [one for one in psutil.Process().children() if one.status() == psutil.STATUS_ZOMBIE]

    def files(self, name: str = "*") -> list[str]:
        """Files that are there."""
        return [str(path.relative_to(self.folder)) for path in self.folder.rglob(name)]


@contextmanager
def hostile_room(folder: Path, timeout: float, command: list[str] = COMMAND) -> Iterator[Room]:
    """Room whose generator takes, as parameter `how`, the way to misbehave; after it nothing is left."""
    mark, space = uuid.uuid4().hex, read_space(SPACE)
    how = Parameter("how", kind="choice", choices=("well", *kinds()), default="well")
    space = ParameterSpace((*space.parameters, how))
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TMPDIR", str(folder))
        patch.setattr(tempfile, "tempdir", str(folder))
        patch.setenv("HOSTILE_ROOM", mark)
        generator = External(command=command, space=space, timeout=timeout, memory=0.45)
        room = Room(generator, folder, mark)
        room.grow()
        yield room
        generator.close()
        assert room.processes(with_guard=True) == []
        assert room.zombies() == []
        assert room.files() == []


def but_slow(faults: Iterable[str], *slow: str) -> list[ParameterSet]:
    """Names of `faults` as parameters of a test, marked where they take long or are much like another one."""
    return [pytest.param(how, marks=[pytest.mark.slow] if how in slow else []) for how in faults]


def kinds() -> dict[str, str]:
    """Ways to misbehave, and what they do."""
    told = subprocess.run([*COMMAND, "--list"], capture_output=True, text=True, check=True)
    return dict(json.loads(told.stdout))


def peak_memory() -> int:
    """Bytes that this process has had at most since the last call; 0 where the system does not tell."""
    try:
        found = re.search(r"VmHWM:\s+(\d+)", Path("/proc/self/status").read_text())
        Path("/proc/self/clear_refs").write_text("5")
    except OSError:
        return 0
    return int(found[1]) * 1024 if found else 0
