"""Pages that the system had to give to this process: memory that is allocated anew in every call shows here."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib.util import find_spec
from typing import TypeVar

Argument = TypeVar("Argument")
ROUNDS = 10


def faults_per_call(call: Callable[[Argument], object], arguments: Sequence[Argument]) -> float | None:
    """Minor page faults of a call, the least of some rounds; None where the system does not count them."""
    if find_spec("resource") is None:
        return None
    rounds = []
    for _ in range(ROUNDS):
        before = _faults()
        for argument in arguments:
            call(argument)
        rounds.append((_faults() - before) / len(arguments))
    return min(rounds)


def _faults() -> int:
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt
