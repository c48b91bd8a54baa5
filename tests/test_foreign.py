"""What a run makes of a generator that fails now and then, dies, or does not do the same twice."""

from __future__ import annotations

import logging
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.conftest import blob
from tests.foreign import Foreign, dead, dead_from, now_and_then, unsure
from treefit.distinct import Distinct
from treefit.evaluation import Evaluator
from treefit.fit import Result, fit
from treefit.plant import Budget
from treefit.plant.characteristics import Characteristics
from treefit.progress import Failure
from treefit.racing import Seeds
from treefit.regrowth import GoneError, SearchError
from treefit.search import CMAES
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView

LEFT_OUT = "a tree is left out, it could not be grown again: "


def small(generator: Foreign, **changes: Any) -> Result:
    settings: dict[str, Any] = {
        "optimizer": CMAES(evaluations=500), "view": OrthographicView(resolution=64), "similarity": PaperSimilarity(),
        "characteristics": Characteristics(vertices=400), "evaluator": Evaluator("serial"), "other_seeds": 1,
        "runners_up": 0.0, "budget": Budget(10**6, 10**6), "distinct": Distinct(0.02, 0.5, 0.02), **changes,
    }  # fmt: skip
    return fit(blob(256, 256), generator, **settings)


def genomes(result: Result) -> list[bytes]:
    return [candidate.genome.tobytes() for candidate in result.candidates]


@pytest.fixture(scope="module")
def sane() -> Result:
    """The same search by a generator that does not fail."""
    return small(Foreign())


@pytest.mark.parametrize("runners_up", [0.0, 0.3])
def test_a_generator_that_fails_now_and_then_costs_those_trees_only(runners_up: float) -> None:
    result = small(Foreign(now_and_then(7)), runners_up=runners_up)
    assert len(result.candidates) == 3
    assert result.evaluations == 500
    assert 500 / 7 - 20 < result.failures["TimedOut"] < 500 / 7 + 20
    for candidate in result.candidates:
        assert candidate.score.total == result.objective.score(candidate.plant).total > 0


def test_a_foreign_generator_is_searched_as_one_of_our_own(sane: Result) -> None:
    own = Foreign(pure=True)
    found = small(own)
    assert genomes(sane) == genomes(found)
    assert [line.best for line in sane.history] == [line.best for line in found.history]
    foreign = sane.objective.generator
    assert isinstance(foreign, Foreign)
    improvements = len({line.best for line in sane.history})
    assert len(own.calls) < len(foreign.calls) <= len(own.calls) + improvements < 1.1 * len(own.calls)


def test_workers_do_not_change_what_a_foreign_generator_leads_to(sane: Result) -> None:
    assert genomes(small(Foreign(), evaluator=Evaluator("threads", 3, 5))) == genomes(sane)


def test_one_that_is_dead_from_the_beginning_is_not_asked_for_long() -> None:
    generator, told = Foreign(dead), list[Failure]()
    with pytest.raises(SearchError, match="first reason: TimedOut: no answer within 5 s"):
        small(generator, optimizer=CMAES(evaluations=50_000), on_generation=lambda _, failed: told.extend(failed))
    assert len(told) == len(generator.calls) - 1 == 132  # three generations; one was grown before the clock starts


@pytest.mark.parametrize("first", [260, 261, 270])
def test_one_that_dies_ends_the_search_and_leaves_a_checkpoint_from_which_the_whole_result_comes(
    tmp_path: Path, sane: Result, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch, first: int
) -> None:
    monkeypatch.setattr(sys.modules["treefit.fit"], "CHECKPOINT_SECONDS", 0.0)
    generator = Foreign(dead_from(first))
    with caplog.at_level(logging.WARNING), pytest.raises(GoneError, match="grown again; the first reason: TimedOut"):
        small(generator, checkpoint=tmp_path / "c.npz")
    assert caplog.messages[0].startswith("the generator failed 200 times in a row: the search ends here; the last")
    assert len(generator.calls) < first + 200 + 20
    resumed = small(Foreign(), checkpoint=tmp_path / "c.npz")
    assert genomes(resumed) == genomes(sane)
    assert [line.best for line in resumed.history] == [line.best for line in sane.history]
    assert resumed.failures == {}


def test_one_that_lives_again_ends_early_with_what_was_found(tmp_path: Path) -> None:
    result = small(Foreign(dead_from(240, 440)), runners_up=0.3, optimizer=CMAES(evaluations=5000))
    assert len(result.candidates) == 3
    assert result.failures == {"TimedOut": 200}
    assert 400 < result.evaluations <= 440
    assert result.candidates[0].score.total == result.history[-1].best


@pytest.mark.parametrize("seeds", [Seeds(), Seeds(3), Seeds(2, racing=False)])
def test_a_tree_that_does_not_come_out_the_same_is_never_the_best(seeds: Seeds) -> None:
    seen: list[Failure] = []
    result = small(Foreign(unsure(0.3)), seeds=seeds, on_generation=lambda _, failed: seen.extend(failed))
    assert result.failures.keys() == {"NotDeterministic"}
    assert all(float(failure.values["wobble"]) <= 0.3 for failure in seen)
    assert "and grown again 0." in seen[0].reason
    assert all(float(candidate.values["wobble"]) > 0.3 for candidate in result.candidates)
    assert all(
        float(result.objective.space.decode(np.array(found.genome))["wobble"]) > 0.3 for found in result.improvements
    )
    assert result.candidates[0].score.total == result.history[-1].best > 0.2


@pytest.mark.parametrize("seeds", [Seeds(), Seeds(3)])
def test_one_that_never_does_the_same_ends_the_run(seeds: Seeds) -> None:
    generator = Foreign(unsure(1.0))
    with pytest.raises(SearchError, match="the first reason: NotDeterministic: its score was 0"):
        small(generator, seeds=seeds)
    assert len(generator.calls) < 500


def test_a_candidate_that_cannot_be_grown_again_is_left_out_and_told_and_another_one_takes_its_place(
    sane: Result, caplog: pytest.LogCaptureFixture
) -> None:
    best = sane.candidates[0]
    lost: list[tuple[int, Failure]] = []
    searched: list[int] = []

    def mood(number: int, values: Any, seed: int) -> int:
        return dead() if searched and dict(values) == dict(best.values) else seed

    with caplog.at_level(logging.WARNING):
        result = small(
            Foreign(mood), on_left_out=lambda number, failure: lost.append((number, failure)),
            on_generation=lambda now, _: searched.append(1) if now.evaluations >= 500 else None,
        )  # fmt: skip
    assert best.genome.tobytes() not in genomes(result)
    assert genomes(sane)[1] in genomes(result)
    assert [message for message in caplog.messages if LEFT_OUT in message] == [
        f"{LEFT_OUT}TimedOut: no answer within 5 s"
    ]
    assert lost == [(len(result.history), Failure("TimedOut: no answer within 5 s", best.values, 0))]
    assert result.failures == {"TimedOut": 1}
