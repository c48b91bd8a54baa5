"""Children: the running copies of one program, as many as trees are asked for at once, and their scratch folder."""

from __future__ import annotations

import itertools
import os
import subprocess
import threading
import time
import uuid
import weakref
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from generators.external.child import Child
from generators.external.faults import NoTree, Refused, TooLarge
from generators.external.guard import start_guard
from generators.external.limits import Limits
from generators.external.marks import MARK
from generators.external.scratch import remove, scratch_folder

PATIENCE = 0.3
"""Seconds that programs have at the end to go by themselves."""


class Children:
    """Copies of `command`; one that failed is ended, with all that it started, and the next request has a new one."""

    def __init__(self, command: Sequence[str], limits: Limits, environment: Mapping[str, str]) -> None:
        self._command, self._limits = list(command), limits
        self._idle: list[Child] = []
        self._lock, self._numbers = threading.Lock(), itertools.count(1)
        self._room = _Room()
        self.environment = {**environment, MARK: self._room.mark}
        self._close = weakref.finalize(self, _close, self._idle, self._room, os.getpid())

    @contextmanager
    def one(self) -> Iterator[Child]:
        """Keep one for a request: an idle one, else a new one."""
        with self._lock:
            child = self._idle.pop() if self._idle else None
        if child is not None and not child.alive:
            child.end()
            child = None
        child = child or Child(self._command, self.folder(), self._limits, self.environment)
        try:
            yield child
        except (Refused, NoTree, TooLarge):  # it did as it was asked, only the tree is none
            self._keep(child)
            raise
        except BaseException:
            child.end()
            raise
        self._keep(child)

    def _keep(self, child: Child) -> None:
        if child.full:
            child.end()
        else:
            self._idle.append(child)

    def folder(self) -> Path:
        """A new place in the scratch folder, not made yet."""
        with self._lock:
            return self._room.folder() / str(next(self._numbers))

    def close(self) -> None:
        """End all of them, and remove the scratch folder."""
        self._close()


class _Room:
    """Scratch folder of the programs, made when the first one needs it, and the guard over both."""

    def __init__(self) -> None:
        self.mark = uuid.uuid4().hex
        self._folder: Path | None = None
        self._guard: subprocess.Popen[bytes] | None = None

    def folder(self) -> Path:
        """The folder."""
        if self._folder is None:
            self._folder = scratch_folder()
            self._guard = start_guard(self.mark, self._folder)
        return self._folder

    def clear(self) -> None:
        """Remove the folder; nobody needs a guard any more."""
        if self._guard is not None:
            self._guard.kill()
            self._guard.communicate()
        if self._folder is not None:
            remove(self._folder)
        self._folder = self._guard = None


def _close(idle: list[Child], room: _Room, owner: int) -> None:
    if os.getpid() != owner:  # a forked copy of the process has none of its own
        return
    for child in idle:
        child.hang_up()
    end = time.perf_counter() + PATIENCE
    while idle:
        idle.pop().end(max(end - time.perf_counter(), 0.0))
    room.clear()
