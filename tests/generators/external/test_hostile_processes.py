"""Programs that leave processes and files behind: all of it is gone when their generator is closed, or ends with it."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import time
import uuid
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from generators.external import External
from tests.generators.external.hostile_room import COMMAND, HERE, SPACE, Fault, Room, but_slow, hostile_room
from treefit.plant import Budget

pytestmark = pytest.mark.slow

ENDED: dict[str, Fault] = {
    "fork_and_die": ("Died", "status 3"), "fork_and_hang": ("TimedOut", "no tree in 0.4 s"),
    "daemon_and_die": ("Died", "status 3"), "daemon_and_hang": ("TimedOut", "no tree in 0.4 s"),
    "fork_on": ("Died", "status 3"),
}  # fmt: skip
STAYING = ("fork_and_answer", "daemon_and_answer")
LITTER = ("litter", "lock_folder")
OUT_OF_REACH = ("bare_daemon", "litter_here")
TESTED = (*ENDED, *STAYING, *LITTER, *OUT_OF_REACH, "leak")


@pytest.fixture
def room(tmp_path: Path) -> Iterator[Room]:
    with hostile_room(tmp_path, timeout=0.4) as room:
        yield room


@pytest.mark.parametrize("how", but_slow(ENDED, "fork_and_hang", "fork_on", "daemon_and_die"))
def test_children_go_with_the_program_that_failed(room: Room, how: str) -> None:
    room.meet(how, ENDED[how])
    assert len(room.processes()) == 1


@pytest.mark.parametrize("how", STAYING)
def test_children_of_a_program_that_is_well_go_when_it_is_closed(room: Room, how: str) -> None:
    room.meet(how, None)
    assert len(room.processes()) == 2  # the room itself sees that nothing is left


@pytest.mark.parametrize("how", LITTER)
def test_what_is_written_beside_the_tree_goes_too(room: Room, how: str) -> None:
    room.meet(how, None)
    room.meet(how, None)


@pytest.mark.slow
def test_a_program_that_hangs_goes_with_a_run_that_is_interrupted(tmp_path: Path) -> None:
    script = (
        "from pathlib import Path\n"
        "from tests.generators.external.hostile_room import hostile_room\n"
        f"with hostile_room(Path({str(tmp_path)!r}), timeout=60) as room:\n"
        "    print(room.mark, flush=True)\n"
        "    room.grow('ignore_sigterm')\n"
    )
    run = subprocess.Popen([sys.executable, "-c", script], cwd=HERE.parents[2], stdout=-1, stderr=-3, text=True)
    assert run.stdout is not None
    room = Room(generator=None, folder=tmp_path, mark=run.stdout.readline().strip())  # type: ignore[arg-type]
    time.sleep(0.3)
    assert len(room.processes()) == 1
    run.send_signal(signal.SIGINT)
    assert run.wait(10) != 0
    run.stdout.close()
    wait_for(lambda: room.processes() == [])
    assert room.files() == []


def test_a_copy_in_another_process_has_programs_of_its_own(room: Room) -> None:
    copy = pickle.loads(pickle.dumps(room.generator))
    mine = room.processes()
    plant = copy(copy.space.complete({}), 7, Budget())
    assert len(room.processes()) == 2
    copy.close()
    assert room.processes() == mine
    assert plant.position.tobytes() == room.grow().position.tobytes()


def wait_for(there: Callable[[], bool], seconds: float = 10) -> None:
    end = time.perf_counter() + seconds
    while not there():
        assert time.perf_counter() < end
        time.sleep(0.02)


@pytest.mark.slow
def test_a_program_that_leaks_costs_no_tree(room: Room) -> None:
    for seed in range(120):
        assert room.grow("leak", seed).n_vertices == 212
    assert len(room.processes()) == 1


ALONE = """
import sys, threading
from pathlib import Path
from generators.external import External
from generators.external.space import read_space
from treefit.plant import Budget
generator = External(command=sys.argv[2:], space=read_space(sys.argv[1]), timeout=60)
threading.Timer(0.7, lambda: print(generator._children.folder().parent, flush=True)).start()
generator(generator.space.complete({}), 1, Budget())
"""


@pytest.mark.parametrize("how", ["hang", "spin"])
def test_nothing_is_left_when_who_started_them_is_killed(how: str) -> None:
    command = [sys.executable, "-c", ALONE, str(SPACE), *COMMAND, "--how", how, "--share", "1"]
    mark = uuid.uuid4().hex
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, text=True, env={**os.environ, "HOSTILE_ROOM": mark}
    ) as alone:
        assert alone.stdout is not None
        scratch = Path(alone.stdout.readline().strip())
        room = Room(External(command=COMMAND, space=SPACE), scratch, mark)
        assert len(room.processes(with_guard=True)) == 3
        alone.kill()
    end = time.monotonic() + 5
    while (room.processes(with_guard=True) or scratch.exists()) and time.monotonic() < end:
        time.sleep(0.05)
    assert room.processes(with_guard=True) == []
    assert not scratch.exists()


def test_a_refused_tree_leaves_no_file(room: Room) -> None:
    room.meet("raise", ("Refused", "the bark"))
    (child,) = room.generator._children._idle
    assert list(child.folder.glob("tree-*")) == []
