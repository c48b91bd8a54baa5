"""When a generator is held to be dead, and that a watch changes nothing of one that lives."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from treefit import watch as module
from treefit.objective import UNGROWN, Score
from treefit.search.optimizer import Genomes, Scores
from treefit.watch import Watch

FINE, FAILED, LARGE = Score(0.5), Score(0.0, failure="TimedOut: no answer"), Score(0.0, failure="over budget: large")


class Clockwork:
    """A batch that takes `seconds` a genome for each of two workers; row i of the genomes is the number i."""

    def __init__(self, found: Sequence[Score], seconds: float, monkeypatch: pytest.MonkeyPatch) -> None:
        self.found, self.seconds, self.now = found, seconds, 0.0
        self.asked: list[int] = []
        monkeypatch.setattr(module.time, "perf_counter", lambda: self.now)

    def __call__(self, genomes: Genomes, floors: Scores) -> list[Score]:
        self.now += self.seconds * len(genomes) / 2
        numbers = genomes[:, 0].astype(int).tolist()
        assert floors.tolist() == numbers
        self.asked += numbers
        return [self.found[i] for i in numbers]


def rows(count: int) -> tuple[Genomes, Scores]:
    return np.arange(count, dtype=float)[:, None], np.arange(count, dtype=float)


@pytest.mark.parametrize(("seconds", "most"), [(0.001, 200), (5.0, 8), (60.0, 8)])
def test_what_only_fails_is_given_up_within_seconds_in_the_middle_of_a_batch(
    seconds: float, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    batch, guard = Clockwork([FAILED] * 1000, seconds, monkeypatch), Watch(2)
    scores = guard.over(batch)(*rows(1000))
    assert batch.asked == list(range(most))
    assert scores == [FAILED] * most + [Score(0.0, failure=UNGROWN)] * (1000 - most)
    assert guard.dead
    assert guard.skipped == 1000 - most
    assert guard.over(batch)(*rows(3)) == [Score(0.0, failure=UNGROWN)] * 3
    assert len(batch.asked) == most


@pytest.mark.parametrize("workers", [1, 2, 7, 64])
def test_with_any_workers_it_dies_at_the_same_failure(workers: int, monkeypatch: pytest.MonkeyPatch) -> None:
    found = [*[FAILED] * 150, *[FINE] * 7, *[FAILED] * 1000]
    guard = Watch(workers)
    scores = guard.over(Clockwork(found, 0.0, monkeypatch))(*rows(len(found)))
    assert sum(score.failure == UNGROWN for score in scores) == 1000 - module.MOST


@pytest.mark.parametrize("found", [[FINE, *[FAILED] * 7] * 60, [LARGE] * 500, [*[FAILED] * 199, FINE] * 3])
def test_one_that_lives_is_asked_for_everything_in_order(found: list[Score], monkeypatch: pytest.MonkeyPatch) -> None:
    seconds = 30.0 if len(found) < 600 else 0.0
    batch, guard = Clockwork(found, seconds, monkeypatch), Watch(2)
    assert guard.over(batch)(*rows(len(found))) == found
    assert batch.asked == list(range(len(found)))
    assert not guard.dead


@pytest.mark.parametrize(("seconds", "most"), [(0.001, 200), (5.0, 16), (60.0, 8)])
def test_one_that_dies_late_is_given_up_a_slice_later_at_most(
    seconds: float, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    batch, guard = Clockwork([*[FINE] * 504, *[FAILED] * 496], seconds, monkeypatch), Watch(2)
    guard.over(batch)(*rows(1000))
    assert guard.dead
    assert 504 + most <= len(batch.asked) <= 504 + most + 2 * module.AT_EASE


def test_a_pure_generator_is_left_alone() -> None:
    def batch(genomes: Genomes, floors: Scores) -> list[Score]:
        return [FAILED] * len(genomes)

    guard = Watch(2, pure=True)
    assert guard.over(batch) is batch
    assert not guard.in_doubt


@pytest.mark.parametrize(("found", "doubt"), [([FINE, FAILED], True), ([FAILED, FINE], False), ([FAILED] * 3, True)])
def test_a_failure_is_in_doubt_until_the_next_plant(
    found: list[Score], doubt: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    guard = Watch(2)
    guard.over(Clockwork(found, 0.0, monkeypatch))(*rows(len(found)))
    assert guard.in_doubt == doubt
