"""Process: a foreign program that is watched, and that goes with all its children when it has to go."""

from __future__ import annotations

import os
import queue
import signal
import subprocess
import threading
import time
import uuid
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path

import psutil

from generators.external.answers import Answer, Answers, Ended, TooMuch
from generators.external.faults import Died, Flooded, OutOfMemory, TimedOut
from generators.external.limits import GIB, Limits
from generators.external.marks import MARK, end_marked

LOOK = 0.05
"""Seconds between two looks at the memory of a process that is at work."""


class Process:
    """A running program: its output is read all the time, its limits are watched while somebody waits for it."""

    def __init__(
        self, command: Sequence[str], folder: Path, limits: Limits, environment: Mapping[str, str], *, listens: bool
    ) -> None:
        self.limits, self._started = limits, time.time() - 1.0
        self._mark = f"{environment.get(MARK, '')}/{uuid.uuid4().hex}"
        try:
            self._process = subprocess.Popen(
                list(command), stdin=subprocess.PIPE if listens else subprocess.DEVNULL, stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT, start_new_session=True, bufsize=0,
                env={**_ONE_THREAD, **os.environ, **environment, **dict.fromkeys(_TEMPORARY, str(folder)),
                     MARK: self._mark},
            )  # fmt: skip
        except OSError as error:
            raise Died(f"cannot start {command[0]}: {error.strerror or error}") from None
        assert self._process.stdout is not None
        self.answers = Answers()
        reader = threading.Thread(target=self.answers.read, args=(self._process.stdout,), daemon=True)
        reader.start()
        _limit(self._process.pid, limits)

    @property
    def alive(self) -> bool:
        """Whether it runs."""
        return self._process.poll() is None

    def write(self, line: bytes) -> None:
        """Send `line` to it; Died when it does not listen any more."""
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(line)
        except (OSError, ValueError):
            raise self.died() from None

    def wait(self, seconds: float) -> Answer | None:
        """Next answer, None when the process has ended with status 0; a fault when a limit is passed or it died.

        `seconds` are those that it has left.
        """
        end = time.perf_counter() + seconds
        while True:
            left = end - time.perf_counter()
            if left <= 0:
                raise TimedOut(f"no tree in {self.limits.timeout:g} s{self.answers.quoted()}")
            try:
                found = self.answers.queue.get(timeout=min(left, LOOK))
            except queue.Empty:
                self.check_memory()
                if self.alive:
                    continue
                found = self.answers.last()
            if isinstance(found, TooMuch):
                raise Flooded(f"printed more than {found.limit // 2**20} MiB for one tree")
            if not isinstance(found, Ended):
                return found
            if self._status(max(left, 0.0)) == 0:
                return None
            raise self.died()

    def died(self) -> Died:
        """Fault that tells how it ended, and its last words."""
        status = self._status(0.2)
        if status is None:
            return Died(f"closed its input or output{self.answers.quoted()}")
        how = f"status {status}" if status >= 0 else f"signal {_signal_name(-status)}"
        return Died(f"the program ended with {how}{self.answers.quoted()}")

    def held(self, *, with_children: bool) -> int:
        """Bytes of memory that it holds; what several share is counted once, where the system can tell."""
        processes: list[psutil.Process] = []
        with suppress(psutil.Error):
            processes = [psutil.Process(self._process.pid)]
            processes += processes[0].children(recursive=True) if with_children else []
        held = sum(_resident(one) for one in processes)
        several = len(processes) > 1 and held > self.limits.memory
        return sum(_share(one) for one in processes) if several else held

    def check_memory(self) -> None:
        """Raise OutOfMemory when it holds more, with its children, than it may."""
        held = self.held(with_children=True)
        if held > self.limits.memory:
            raise OutOfMemory(f"took {held / GIB:.2g} GiB of memory, over {self.limits.memory / GIB:g}")

    def hang_up(self) -> None:
        """Tell it that nothing more comes."""
        with suppress(OSError):
            if self._process.stdin is not None:
                self._process.stdin.close()

    def end(self, patience: float = 0.0) -> None:
        """End it with all of its children; `patience` are seconds in which it may go by itself."""
        self.hang_up()
        self._status(patience)
        descendants: list[psutil.Process] = []
        with suppress(psutil.Error):
            descendants = psutil.Process(self._process.pid).children(recursive=True)
        with suppress(OSError, AttributeError):  # no such call on Windows
            os.killpg(self._process.pid, signal.SIGKILL)
        with suppress(OSError):
            self._process.kill()
        for one in descendants:
            with suppress(psutil.Error):
                one.kill()
        end_marked(self._mark, self._started)
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(2.0)
        self._process.stdout.close() if self._process.stdout is not None and self.answers.ended.wait(0.2) else None

    def _status(self, seconds: float) -> int | None:
        """Its exit status, awaited for so long; None when it still runs."""
        with suppress(subprocess.TimeoutExpired):
            return self._process.wait(seconds)
        return None


_TEMPORARY = ("TMPDIR", "TEMP", "TMP")
_ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Each core has a worker with a program of its own; numpy alone takes half of the time to start."""


def _limit(pid: int, limits: Limits) -> None:
    """No dumps of memory, no endless files, where the system can be told so."""
    with suppress(AttributeError, psutil.Error, OSError):
        process = psutil.Process(pid)
        process.rlimit(psutil.RLIMIT_CORE, (0, 0))
        process.rlimit(psutil.RLIMIT_FSIZE, (limits.file, limits.file))


def _resident(process: psutil.Process) -> int:
    with suppress(psutil.Error):
        return int(process.memory_info().rss)
    return 0


def _share(process: psutil.Process) -> int:
    """Bytes that it holds, its part of those that it shares with others."""
    with suppress(psutil.Error):
        held = process.memory_full_info()
        return int(getattr(held, "pss", held.rss))
    return 0


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return str(number)
