"""Time of a call, so that it can be compared on a busy machine: medians of short rounds, rivals in turn."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from statistics import median
from typing import TypeVar

Argument = TypeVar("Argument")
ROUNDS = 7


def cpu_ms(call: Callable[[Argument], object], arguments: Sequence[Argument], rounds: int = ROUNDS) -> float:
    """Milliseconds a call of this thread's processor time: median over rounds of the mean over `arguments`."""
    return in_turn({"": call}, arguments, rounds)[""]


def wall_ms(call: Callable[[Argument], object], arguments: Sequence[Argument], rounds: int = ROUNDS) -> float:
    """As cpu_ms in time on the clock, for what works on threads of its own."""
    return in_turn({"": call}, arguments, rounds, time.perf_counter)[""]


def in_turn(
    calls: Mapping[str, Callable[[Argument], object]],
    arguments: Sequence[Argument],
    rounds: int = ROUNDS,
    clock: Callable[[], float] = time.thread_time,
) -> dict[str, float]:
    """Milliseconds of each of `calls`, one after the other within every round: what slows one down slows all."""
    taken: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(rounds + 1):  # the first one warms up
        for name, call in calls.items():
            started = clock()
            for argument in arguments:
                call(argument)
            taken[name].append((clock() - started) / len(arguments) * 1e3)
    return {name: median(times[1:]) for name, times in taken.items()}
