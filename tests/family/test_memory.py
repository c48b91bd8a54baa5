"""The memory of earlier fits: what it keeps, what it finds, and how it takes what is wrong."""

from __future__ import annotations

import logging
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from treefit.checkpoint import write_checkpoint
from treefit.family.memory import Memory

WIDTHS = (0.1, 0.2, 0.3, 0.4, 0.5)


class Newer(SimpleGen):
    version: ClassVar[str] = "999"


def filled(folder: Path, size: int = 200) -> Memory:
    memory = Memory(folder, size)
    for i, width in enumerate(WIDTHS):
        memory.add(SimpleGen(), blob(crown=width), {"wobble": width / 10, "levels": 3}, 2**62 + i, 0.5)
    return memory


def test_the_fits_of_the_most_similar_pictures_come_first(tmp_path: Path) -> None:
    memory = filled(tmp_path / "new")
    found = memory.recall(SimpleGen(), blob(crown=0.39), 3)
    assert [fit.values for fit in found] == [{"wobble": width / 10, "levels": 3} for width in (0.4, 0.3, 0.5)]
    assert [fit.seed - 2**62 for fit in found] == [3, 2, 4]
    assert isinstance(found[0].values["levels"], int)
    assert memory.recall(SimpleGen(), blob(crown=0.39), 0) == []
    assert [fit.seed - 2**62 for fit in memory.recall(SimpleGen(), blob(crown=0.39), 3, within=0.03)] == [3]
    assert sorted(file.name for file in (tmp_path / "new").glob("*.npz*")) == ["simplegen.npz", "simplegen.npz.lock"]


def test_the_oldest_go_when_there_are_too_many(tmp_path: Path) -> None:
    found = filled(tmp_path, 2).recall(SimpleGen(), blob(), 9)
    assert {fit.seed - 2**62 for fit in found} == {3, 4}


@pytest.mark.parametrize(("score", "kept"), [(0.4, 0.5), (0.6, 0.6)])
def test_of_two_fits_of_one_picture_the_better_is_kept(tmp_path: Path, score: float, kept: float) -> None:
    memory = filled(tmp_path)
    memory.add(SimpleGen(), blob(crown=0.2), {"wobble": 0.19}, 7, score)
    found = memory.recall(SimpleGen(), blob(crown=0.2), 9)
    assert len(found) == len(WIDTHS)
    assert found[0].score == kept


def test_another_version_is_left_out_in_one_line_and_forgotten_by_the_next_fit(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    memory = filled(tmp_path)
    with caplog.at_level(logging.WARNING):
        assert memory.recall(Newer(), blob(), 3) == []
    assert [line.getMessage() for line in caplog.records] == [
        f"memory: 5 of 5 fits in {tmp_path / 'simplegen.npz'} are not of version 999 of simplegen and left out"
    ]
    memory.add(Newer(), blob(), {}, 1, 0.1)
    assert len(memory.recall(Newer(), blob(), 9)) == 1
    assert memory.recall(SimpleGen(), blob(), 9) == []


def test_values_that_the_generator_no_longer_takes_are_left_out(tmp_path: Path) -> None:
    memory = filled(tmp_path)
    memory.add(SimpleGen(), blob(bare=0.5), {"wobbel": 0.1}, 1, 0.9)
    assert len(memory.recall(SimpleGen(), blob(), 9)) == len(WIDTHS)


def test_a_damaged_file_is_put_aside_in_one_line(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    memory = filled(tmp_path)
    path = memory.file(SimpleGen())
    whole = path.read_bytes()
    for damaged in (whole[:-200], whole[:300] + b"x" + whole[301:], b"", b"PK"):
        caplog.clear()
        path.write_bytes(damaged)
        with caplog.at_level(logging.WARNING):
            assert memory.recall(SimpleGen(), blob(), 3) == []
        assert [line.getMessage() for line in caplog.records] == [
            f"memory: {path} is damaged; it is now simplegen.npz.damaged and a new one is begun"
        ]
        assert path.with_name("simplegen.npz.damaged").read_bytes() == damaged
    memory.add(SimpleGen(), blob(), {"wobble": 0.1}, 0, 0.5)
    assert len(memory.recall(SimpleGen(), blob(), 3)) == 1


def test_a_file_of_something_else_counts_as_damaged(tmp_path: Path) -> None:
    memory = Memory(tmp_path)
    write_checkpoint(memory.file(SimpleGen()), {"genomes": np.zeros((2, 3))}, {"fits": [{}]})
    assert memory.recall(SimpleGen(), blob(), 3) == []
    assert (tmp_path / "simplegen.npz.damaged").exists()


def test_fits_that_end_at_once_are_all_kept(tmp_path: Path) -> None:
    def add(i: int) -> None:
        Memory(tmp_path).add(SimpleGen(), blob(crown=0.1 + 0.02 * i), {"wobble": 0.01 * i}, i, 0.5)

    with ThreadPoolExecutor(6) as pool:
        list(pool.map(add, range(12)))
    assert {fit.seed for fit in Memory(tmp_path).recall(SimpleGen(), blob(), 99)} == set(range(12))


def test_a_generator_may_have_any_name(tmp_path: Path) -> None:
    class Odd(SimpleGen):
        name: ClassVar[str] = "../a b"

    assert Memory(tmp_path).file(Odd()) == tmp_path / ".._a_b.npz"
