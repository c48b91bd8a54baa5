"""Programs that die, eat, flood or answer oddly: it is known at once, costs the call at most, and has a name."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.generators.external.hostile_room import Fault, Room, but_slow, hostile_room

pytestmark = pytest.mark.slow

LOUD: dict[str, Fault] = {
    "uncaught": ("Died", "status 1; its last words: .*the bark|is loose"), "segfault": ("Died", "signal SIGSEGV"),
    "exit_0": ("Died", "status 0"), "exit_3": ("Died", "status 3"), "eat_memory": ("OutOfMemory", "GiB of memory"),
    "flood_lines": ("Flooded", "printed more than 16 MiB"), "flood_line": ("Flooded", "printed more than 16 MiB"),
    "flood_stderr": ("Flooded", "printed more than 16 MiB"), "talk": ("Flooded", "printed more than 16 MiB"),
    "raise": ("Refused", "RuntimeError: the bark is loose"), "odd_error": ("Refused", "bark.*loose"),
    "no_error": ("Refused", "no reason"), "not_sure": ("Refused", "no reason"),
    "twice": None, "half_json": None, "same_line": None, "deep_json": None, "odd_json": None, "slowly": None,
}  # fmt: skip


@pytest.fixture(scope="module")
def room(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Room]:
    with hostile_room(tmp_path_factory.mktemp("room"), timeout=10) as room:
        yield room


@pytest.mark.parametrize("how", but_slow(LOUD, "exit_0", "flood_lines", "flood_stderr", "talk"))
def test_a_program_that_dies_floods_or_answers_oddly_is_known_at_once(room: Room, how: str) -> None:
    room.meet(how, LOUD[how])
    assert len(room.processes()) == 1
