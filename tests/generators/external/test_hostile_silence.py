"""Programs that are silent when they should answer, or later: each costs its call, in time, and no other."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

import pytest

from generators.external.faults import Died, TimedOut
from tests.generators.external.hostile_room import Fault, Room, but_slow, hostile_room

pytestmark = pytest.mark.slow

IN_TIME = "no tree in 0.4 s"
SILENT: dict[str, Fault] = {
    "hang": ("TimedOut", IN_TIME), "spin": ("TimedOut", IN_TIME), "stop": ("TimedOut", IN_TIME),
    "ignore_sigterm": ("TimedOut", IN_TIME), "trickle": ("TimedOut", IN_TIME), "late": ("TimedOut", IN_TIME),
    "wrong_id": ("TimedOut", IN_TIME), "close_stdout": ("TimedOut|Died", f"{IN_TIME}|closed its input or output"),
    "close_all": ("Died", "closed its input or output"), "long_error": ("TimedOut", IN_TIME),
}  # fmt: skip


@pytest.fixture(scope="module")
def room(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Room]:
    with hostile_room(tmp_path_factory.mktemp("room"), timeout=0.4) as room:
        yield room


@pytest.mark.parametrize("how", but_slow(SILENT, "spin", "trickle", "late", "stop", "long_error", "wrong_id"))
def test_a_program_that_gives_no_answer_costs_its_timeout(room: Room, how: str) -> None:
    room.meet(how, SILENT[how])
    assert len(room.processes()) == 1


@pytest.mark.parametrize("how", ["deaf", "last_words", "ahead"])
def test_what_a_program_does_after_its_answer_costs_the_next_call_at_most(room: Room, how: str) -> None:
    assert room.grow(how).n_vertices == 212
    with suppress(TimedOut, Died):
        room.grow()
    assert room.grow().n_vertices == 212
