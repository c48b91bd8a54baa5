"""Termination: a SIGTERM ends a run as Ctrl-C does, so that what it has begun is ended and told."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

STOPPED, TERMINATED = 130, 143
"""Exit status after Ctrl-C and after SIGTERM, as shells have it."""


class Terminated(KeyboardInterrupt):
    """Somebody asked the process to end."""


def status_of(stop: KeyboardInterrupt) -> int:
    """Exit status of a run that `stop` has ended."""
    return TERMINATED if isinstance(stop, Terminated) else STOPPED


@contextmanager
def gentle() -> Iterator[None]:
    """Turn the first SIGTERM in the block into Terminated; further ones do not disturb what that one has begun."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, _terminate)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _terminate(number: int, _frame: FrameType | None) -> None:
    signal.signal(number, _ignore)  # no SIG_IGN, which programs that are started from now on would inherit
    raise Terminated


def _ignore(_number: int, _frame: FrameType | None) -> None:
    """Do nothing."""
