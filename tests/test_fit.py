from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from tests.failing import Failing
from treefit.checkpoint import CheckpointError, read_checkpoint
from treefit.evaluation import Batch, Evaluator
from treefit.fit import Result, SearchError, Stop, fit
from treefit.improvements import Improvement
from treefit.objective import Objective, Score
from treefit.plant import Budget, Generator, Plant, Preset, Value, Values
from treefit.plant.characteristics import Characteristics
from treefit.progress import Failure, Generation
from treefit.search import RandomSearch, Strategy, TreeGA
from treefit.search.optimizer import Genomes, Scores
from treefit.search.start import Start
from treefit.view import OrthographicView

TARGET = blob(256, 256)
GA = TreeGA(evaluations=600, population=20, start_population=30, generations=10)


def small(generator: Generator | None = None, **changes: Any) -> Result:
    settings: dict[str, Any] = {
        "optimizer": GA, "view": OrthographicView(resolution=64), "characteristics": Characteristics(vertices=400),
        "other_seeds": 1, **changes,
    }  # fmt: skip
    return fit(TARGET, generator or SimpleGen(), **settings)


def genomes(result: Result) -> list[bytes]:
    return [candidate.genome.tobytes() for candidate in result.candidates]


def kill(generation: Generation, failures: list[Failure]) -> None:
    if generation.number == 9:
        raise KeyboardInterrupt


def test_a_fit_ends_with_distinct_candidates_best_first() -> None:
    result = small(candidates=3)
    scores = [candidate.score.total for candidate in result.candidates]
    assert len(set(genomes(result))) == 3
    assert scores == sorted(scores, reverse=True)
    assert scores[0] == result.history[-1].best > 0.25
    assert result.evaluations == 600


def test_a_fit_tells_of_every_new_best_plant_and_keeps_how_it_came() -> None:
    told: list[tuple[Improvement, Objective]] = []
    result = small(on_improvement=lambda found, objective: told.append((found, objective)))
    scores = [found.score for found, _ in told]
    assert scores == sorted(set(scores))
    assert set(result.improvements) <= {found for found, _ in told}
    best, objective = result.improvements[-1], told[-1][1]
    assert best.score == result.history[-1].best
    assert best.evaluations == min(line.evaluations for line in result.history if line.best == best.score)
    assert objective.score(objective.grow(np.array(best.genome), objective.seed)).total == best.score
    assert result.objective.generator is objective.generator


def test_a_fit_that_goes_on_tells_of_its_best_plant_at_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys.modules["treefit.fit"], "CHECKPOINT_SECONDS", 0.0)
    with pytest.raises(KeyboardInterrupt):
        small(checkpoint=tmp_path / "c.npz", on_generation=kill)
    told: list[tuple[int, Improvement]] = []
    lines: list[Generation] = []
    small(checkpoint=tmp_path / "c.npz", on_generation=lambda now, _: lines.append(now),
          on_improvement=lambda found, _: told.append((len(lines), found)))  # fmt: skip
    assert told[0][0] == 0
    assert told[0][1].evaluations <= lines[0].evaluations


def test_workers_do_not_change_the_result() -> None:
    assert genomes(small(evaluator=Evaluator("serial"))) == genomes(small(evaluator=Evaluator("threads", 2, 3)))


@pytest.mark.parametrize(("seconds", "first"), [(0.0, 10), (100.0, 1)])
def test_a_fit_that_was_killed_goes_on_from_its_checkpoint_to_the_same_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, seconds: float, first: int
) -> None:
    monkeypatch.setattr(sys.modules["treefit.fit"], "CHECKPOINT_SECONDS", seconds)
    with pytest.raises(KeyboardInterrupt):
        small(checkpoint=tmp_path / "c.npz", on_generation=kill)
    numbers: list[int] = []
    resumed = small(checkpoint=tmp_path / "c.npz", on_generation=lambda now, _: numbers.append(now.number))
    whole = small()
    assert genomes(resumed) == genomes(whole)
    assert [line.best for line in resumed.history] == [line.best for line in whole.history]
    assert numbers[0] == first


class DrawsAll(Evaluator):
    """Evaluator that draws every plant, hopeless or not."""

    @contextmanager
    def started(self, objective: Objective) -> Iterator[Batch]:
        with super().started(objective) as batch:
            yield lambda genomes, floors: batch(genomes, np.full(len(floors), -np.inf))


@pytest.mark.parametrize("optimizer", [replace(GA, evaluations=1500), RandomSearch(600, 60)])
def test_leaving_hopeless_plants_undrawn_changes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, optimizer: Strategy
) -> None:
    monkeypatch.setattr(sys.modules["treefit.fit"], "CHECKPOINT_SECONDS", 0.0)
    a, b = tmp_path / "a.npz", tmp_path / "b.npz"
    settings = {"optimizer": optimizer, "characteristics": Characteristics(vertices=400, height=12.0, leaf_size=0.1)}
    with pytest.raises(KeyboardInterrupt):
        small(**settings, checkpoint=a, on_generation=kill)
    few = small(**settings, checkpoint=a)
    every = small(**settings, checkpoint=b, evaluator=DrawsAll())
    assert few.history[-1].undrawn > 10
    assert every.history[-1].undrawn == 0
    assert genomes(few) == genomes(every)
    assert [candidate.score for candidate in few.candidates] == [candidate.score for candidate in every.candidates]
    assert few.failures == every.failures
    for now, then in zip(few.history, every.history, strict=True):
        assert (now.best, now.best_image, now.failures) == (then.best, then.best_image, then.failures)
    kept, other = read_checkpoint(a)[0], read_checkpoint(b)[0]
    assert all(kept[name].tobytes() == other[name].tobytes() for name in kept)


def test_a_checkpoint_of_another_search_is_refused(tmp_path: Path) -> None:
    small(checkpoint=tmp_path / "c.npz")
    with pytest.raises(CheckpointError, match="another picture, generator, seed or settings"):
        small(checkpoint=tmp_path / "c.npz", seed=1)


def preset(**values: Value) -> Preset:
    return Preset("simplegen", SimpleGen.version, 0, values)


class Nursery(SimpleGen):
    """SimpleGen with presets."""

    presets: ClassVar[Mapping[str, Preset]] = {"oak": preset(wobble=0.11), "pine": preset(wobble=0.22)}


class Listening(Evaluator):
    """Evaluator that keeps the genomes of every batch."""

    heard: ClassVar[list[np.ndarray]] = []

    @contextmanager
    def started(self, objective: Objective) -> Iterator[Batch]:
        with super().started(objective) as batch:

            def listen(genomes: Genomes, floors: Scores) -> list[Score]:
                self.heard.append(genomes)
                return batch(genomes, floors)

            yield listen


@pytest.mark.parametrize(("start", "asked"), [("random", 0), ("presets", 1), ("mixed", 1)])
def test_a_search_begins_from_the_presets_of_the_generator(start: Start, asked: int) -> None:
    Listening.heard.clear()
    small(Nursery(), optimizer=replace(GA, start=start), evaluator=Listening("serial"))
    for plant in Nursery.presets.values():
        genome = Nursery().space.encode(plant.values)
        assert (Listening.heard[0] == genome).all(axis=1).sum() == asked


def test_a_killed_search_from_presets_goes_on_to_the_same_end_but_not_from_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(KeyboardInterrupt):
        small(Nursery(), checkpoint=tmp_path / "c.npz", on_generation=kill)
    with monkeypatch.context() as patch:
        patch.setattr(Nursery, "presets", {**Nursery.presets, "yew": preset(wobble=0.33)})
        with pytest.raises(CheckpointError, match="belongs to a search with another"):
            small(Nursery(), checkpoint=tmp_path / "c.npz")
    assert genomes(small(Nursery(), checkpoint=tmp_path / "c.npz")) == genomes(small(Nursery()))


class Unstarted(Evaluator):
    """Evaluator that ends the search before its first batch."""

    @contextmanager
    def started(self, objective: Objective) -> Iterator[Batch]:
        raise KeyboardInterrupt
        yield


@pytest.mark.parametrize(("kind", "plants"), [("threads", 1), ("serial", 1), ("processes", 0)])
def test_kernels_compile_before_the_clock_starts_but_never_what_may_crash_the_search(kind: str, plants: int) -> None:
    grown: list[int] = []

    class Counting(SimpleGen):
        def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
            grown.append(seed)
            return super().__call__(values, seed, budget)

    with pytest.raises(KeyboardInterrupt):
        small(Counting(), evaluator=Unstarted(kind))
    assert len(grown) == plants


def test_a_preset_with_a_parameter_that_the_generator_lacks_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Nursery, "presets", {"oak": preset(), "yew": preset(wobbel=0.1)})
    with pytest.raises(ValueError, match=r"preset 'yew' of generator 'simplegen': no parameter 'wobbel'.*'wobble'"):
        small(Nursery())


def test_the_search_stops_at_a_score() -> None:
    result = small(stop=Stop(score=0.3))
    assert result.evaluations < 600
    assert result.history[-1].best >= 0.3


def test_failures_are_counted_told_and_do_not_end_the_run() -> None:
    seen: list[Failure] = []
    result = small(Failing(0.3), on_generation=lambda _, failures: seen.extend(failures))
    told = [failure for failure in seen if "the bark" in failure.reason]
    assert result.failures["RuntimeError"] == len(told) > 20
    assert all(float(failure.values["wobble"]) <= 0.18 for failure in told)
    assert all(float(candidate.values["wobble"]) > 0.18 for candidate in result.candidates)


def test_a_generator_that_always_fails_ends_the_run_with_its_reason() -> None:
    with pytest.raises(SearchError, match="RuntimeError: the bark"):
        small(Failing(1.0))


def test_a_short_search_in_which_all_fails_ends_with_its_reason_too() -> None:
    with pytest.raises(SearchError, match="RuntimeError: the bark"):
        small(Failing(1.0), optimizer=TreeGA(evaluations=10, population=20, start_population=30))


def test_an_empty_mask_is_refused() -> None:
    with pytest.raises(ValueError, match="no tree in it"):
        fit(np.zeros((64, 64), np.uint8), SimpleGen())
