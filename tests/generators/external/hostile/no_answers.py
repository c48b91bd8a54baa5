"""Ways to give no answer: to die, to stand still, to eat."""

import ctypes
import os
import signal
import sys
import time

from hostile.call import Call


def uncaught(call: Call) -> None:
    """Dies with a traceback."""
    raise RuntimeError("the bark\nis loose")


def segfault(call: Call) -> None:
    """Reads at address 0."""
    ctypes.string_at(0)


def exit_0(call: Call) -> None:
    """Ends with status 0 and says nothing."""
    os._exit(0)


def exit_3(call: Call) -> None:
    """Ends with status 3 and says nothing."""
    os._exit(3)


def hang(call: Call) -> None:
    """Sleeps for ever."""
    while True:
        time.sleep(1000)


def spin(call: Call) -> None:
    """Computes for ever."""
    while True:
        pass


def ignore_sigterm(call: Call) -> None:
    """Sleeps for ever and does not listen to signals that ask it to end."""
    for one in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGPIPE):
        signal.signal(one, signal.SIG_IGN)
    hang(call)


def stop(call: Call) -> None:
    """Stops itself, as by Ctrl+Z."""
    os.kill(os.getpid(), signal.SIGSTOP)
    hang(call)


def close_stdout(call: Call) -> None:
    """Closes stdout and lives on."""
    os.close(1)
    hang(call)


def close_all(call: Call) -> None:
    """Closes stdin, stdout and stderr and lives on."""
    os.closerange(0, 3)
    hang(call)


def eat_memory(call: Call) -> None:
    """Takes memory for ever, 100 MB a step, and touches it."""
    eaten = []
    while True:
        eaten.append(bytearray(b"x") * (100 << 20))


def flood_lines(call: Call) -> None:
    """Prints lines for ever."""
    while True:
        os.write(1, b"growing a branch\n" * 4096)


def flood_line(call: Call) -> None:
    """Prints one line without an end."""
    while True:
        os.write(1, b"x" * 65536)


def flood_stderr(call: Call) -> None:
    """Prints on stderr for ever."""
    while True:
        os.write(2, b"warning: bark\n" * 4096)


def trickle(call: Call) -> None:
    """Prints a letter each 20 ms, for ever."""
    while True:
        os.write(1, b".")
        time.sleep(0.02)


def deaf(call: Call) -> None:
    """Answers well and reads nothing more: the next request is for nobody."""
    call.give()
    hang(call)


def last_words(call: Call) -> None:
    """Answers well, then dies."""
    call.give()
    sys.stdout.flush()
    os._exit(1)


def leak(call: Call) -> None:
    """Answers well, and keeps 4 MB more for ever."""
    LEAKED.append(bytearray(b"x") * (4 << 20))
    call.give()


LEAKED: list[bytearray] = []
