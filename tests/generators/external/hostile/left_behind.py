"""Ways to leave something behind: processes that live on, files that nobody asked for."""

import os
import signal
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from hostile.call import Call
from hostile.no_answers import hang


def fork_and_die(call: Call) -> None:
    """Leaves a child that holds stdout open, and ends."""
    _child(_stay)
    os._exit(3)


def fork_and_hang(call: Call) -> None:
    """Makes 8 children, and all sleep for ever."""
    for _ in range(8):
        _child(_stay)
    hang(call)


def fork_and_answer(call: Call) -> None:
    """Leaves a child and answers well."""
    _child(_stay)
    call.give()


def daemon_and_die(call: Call) -> None:
    """Leaves a grandchild in a session of its own that holds stdout open, and ends."""
    _daemon()
    os._exit(3)


def daemon_and_hang(call: Call) -> None:
    """Leaves a grandchild in a session of its own, and sleeps for ever."""
    _daemon()
    hang(call)


def daemon_and_answer(call: Call) -> None:
    """Leaves a grandchild in a session of its own and answers well."""
    _daemon()
    call.give()


def bare_daemon(call: Call) -> None:
    """Leaves a grandchild in a session of its own, with no open files and no environment, and ends."""
    _child(lambda: (os.setsid(), _child(lambda: os.execve("/bin/sleep", ["sleep", "1000"], {}))))
    time.sleep(0.05)
    os._exit(3)


def fork_on(call: Call) -> None:
    """Forks and ends again and again: the one that lives always has another number."""
    while True:
        if os.fork():
            os._exit(3)
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        time.sleep(0.01)


def litter(call: Call) -> None:
    """Writes files and folders beside the tree and where temporary files go, and answers well."""
    for place in (call.file.parent, tempfile.gettempdir()):
        folder = Path(tempfile.mkdtemp(prefix="litter", dir=place))
        for name in ("leaf.txt", "-rf", "two\nlines"):
            (folder / name).write_text("green")
    call.give()


def litter_here(call: Call) -> None:
    """Writes a file into the folder where it runs, and answers well."""
    Path("litter.txt").write_text("green")
    call.give()


def lock_folder(call: Call) -> None:
    """Takes the right to write from a folder with files beside the tree, and answers well."""
    folder = call.file.with_name("locked")
    folder.mkdir(exist_ok=True)
    (folder / "leaf").write_text("green")
    folder.chmod(0o500)
    call.give()


def _child(act: Callable[[], object]) -> None:
    """Make a child that does `act` and ends."""
    if os.fork() == 0:
        try:
            act()
        finally:
            os._exit(0)


def _stay() -> None:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    time.sleep(1000)


def _daemon() -> None:
    _child(lambda: (os.setsid(), _child(_stay)))
    time.sleep(0.05)
