"""Programs that say ok to what is no tree: arrays that are wrong, files that are broken, traps, or far too much."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from generators.external.faults import NotDeterministic
from tests.generators.external.hostile_room import Fault, Room, hostile_room, kinds

NO = "NoTree"
TREES: dict[str, Fault] = {
    "nan": (NO, "position has NaN or infinite"), "infinite_width": (NO, "position has NaN or infinite"),
    "too_far": (NO, "position"), "nan_leaf": (NO, "leaf_axis"), "empty": (NO, "empty.*0 vertices"),
    "one_vertex": (NO, "empty.*1 vert"), "a_point": (NO, "at one place"), "flat": None,
    "cycle": (NO, "circle: vertex 3"), "own_parent": (NO, "circle: vertex 5"), "no_root": (NO, "root.*has 0"),
    "two_roots": (NO, "root.*has 2"), "far_parent": (NO, "parent 1000000000 is no vertex, there are 212"),
    "broken_parent": (NO, "parent must be whole numbers"), "text_parent": (NO, "parent must be whole numbers"),
    "complex_position": (NO, "position must be numbers, got complex"), "one_number": (NO, "position must have 2 axes"),
    "two_dimensions": (NO, r"position must have shape \(any, 3\), got \(212, 2\)"),
    "short_radius": (NO, r"parent must have shape \(211,\), got \(212,\)"), "no_radius": (NO, "lacks radius"),
    "short_leaves": (NO, r"leaf_size must have shape \(400, 2\)"), "negative_radius": (NO, "radius must not be neg"),
}  # fmt: skip
FILES: dict[str, Fault] = {
    "no_file": (NO, "said ok, but wrote no"), "folder": (NO, "wrote no"), "fifo": (NO, "wrote no"),
    "device": (NO, "wrote no"), "answer_first": (NO, "wrote no|zip|cut"), "cut_file": (NO, "zip"),
    "garbage_file": (NO, "zip"), "empty_file": (NO, "zip"), "not_zip": (NO, "zip"), "pickle_file": (NO, "zip"),
    "flipped_file": (NO, "."), "pickle": (NO, "radius must be numbers.*object"),
    "huge_file": ("Died", "File too large"), "many_sparse": ("Died", "File too large"),
    "many_claimed": ("TooLarge", "100,000,000"), "many_packed": ("TooLarge", "100,000,000"),
}  # fmt: skip


@pytest.fixture(scope="module")
def room(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Room]:
    with hostile_room(tmp_path_factory.mktemp("trees"), timeout=10) as room:
        yield room


@pytest.mark.parametrize("how", TREES)
def test_arrays_that_are_no_tree_are_told_by_name(room: Room, how: str) -> None:
    room.meet(how, TREES[how])


@pytest.mark.parametrize("how", FILES)
def test_files_that_are_no_tree_are_never_loaded(room: Room, how: str) -> None:
    room.meet(how, FILES[how])
    assert room.files("unpickled") == []


def test_another_tree_of_the_same_values_is_noticed(room: Room) -> None:
    room.grow("random", seed=1)
    with pytest.raises(NotDeterministic, match="same values and seed"):
        room.grow("random", seed=1)
    assert room.grow("random", seed=2).n_vertices == 212


def test_a_program_that_wrote_a_wrong_tree_need_not_start_again(room: Room) -> None:
    before = room.processes()
    room.meet("nan", TREES["nan"])
    assert room.processes() == before


def test_every_kind_is_tested_somewhere() -> None:
    from tests.generators.external import test_hostile_answers as answers
    from tests.generators.external import test_hostile_processes as processes
    from tests.generators.external import test_hostile_silence as silence

    after = {"deaf", "last_words", "ahead", "random"}
    assert {*silence.SILENT, *answers.LOUD, *TREES, *FILES, *processes.TESTED, *after} == kinds().keys()
