from __future__ import annotations

import threading
from dataclasses import replace

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from tests.failing import Failing
from treefit.evaluation import Evaluator, in_parallel, parts
from treefit.fit import aim
from treefit.objective import Objective
from treefit.plant.characteristics import Characteristics
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView


@pytest.fixture(scope="module")
def objective() -> Objective:
    wishes = Characteristics(vertices=500)
    return aim(blob(), SimpleGen(), PaperSimilarity(), wishes, OrthographicView(resolution=64), 0)


@pytest.fixture(scope="module")
def genomes(objective: Objective) -> np.ndarray:
    return np.random.default_rng(5).random((50, len(objective.space)))


@pytest.mark.parametrize(
    "evaluator",
    [Evaluator("threads", 1), Evaluator("threads", 3, 7), Evaluator("auto"), Evaluator("processes", 2, 20)],
    ids=str,
)
def test_scores_do_not_depend_on_workers(objective: Objective, genomes: np.ndarray, evaluator: Evaluator) -> None:
    assert evaluator(objective, genomes) == Evaluator("serial")(objective, genomes)


@pytest.mark.parametrize("kind", ["serial", "threads", "processes"])
def test_every_genome_meets_its_own_floor(objective: Objective, genomes: np.ndarray, kind: str) -> None:
    floors = np.random.default_rng(6).random(len(genomes))
    scores = Evaluator(kind, 2, 7)(objective, genomes, floors)
    assert scores == [objective(genome, floor) for genome, floor in zip(genomes, floors.tolist(), strict=True)]
    assert 10 < sum(score.drawn for score in scores) < 40


def test_a_generator_of_plain_python_goes_to_processes(objective: Objective) -> None:
    slow = replace(objective, generator=Failing(parallel="processes"))
    assert Evaluator().backend(slow) == "processes"
    assert Evaluator().backend(objective) == "threads"


@pytest.mark.slow
def test_a_dying_worker_costs_only_its_candidates(objective: Objective, genomes: np.ndarray) -> None:
    dying = replace(objective, generator=Failing(0.2, "exit", "processes"))
    few = genomes[:6]
    few[:, objective.space.names.index("wobble")] = [0.5, 0.1, 0.6, 0.7, 0.8, 0.9]
    scores = Evaluator("processes", 2, 3)(dying, few)
    assert ["process died" in str(score.failure) for score in scores] == [False, True, False, False, False, False]
    assert scores[2:] == Evaluator("serial")(objective, few[2:])


def test_threads_are_kept_and_raise_what_a_batch_raises(objective: Objective, genomes: np.ndarray) -> None:
    floors = np.full(len(genomes), -np.inf)
    with Evaluator("threads", 2).started(objective) as batch:
        before = set(threading.enumerate())
        first = batch(genomes, floors)
        kept = set(threading.enumerate()) - before
        with pytest.raises(ValueError, match="shorter"):
            batch(genomes, floors[:9])
        assert batch(genomes, floors) == first
    assert len(kept) >= 2


@pytest.mark.parametrize(("count", "workers", "most"), [(1, 2, 32), (50, 2, 32), (400, 8, 32), (7, 1, 3), (0, 2, 4)])
def test_parts_hold_every_genome_once_and_shrink_to_single_ones(count: int, workers: int, most: int) -> None:
    found = [range(count)[part] for part in parts(count, workers, most)]
    assert [i for part in found for i in part] == list(range(count))
    sizes = [len(part) for part in found]
    assert sizes == sorted(sizes, reverse=True)
    assert all(size <= most for size in sizes)
    assert sizes[-2 * workers :] == [1] * min(2 * workers, count) or most < 4


def test_a_setting_out_of_range_is_refused() -> None:
    with pytest.raises(ValueError, match="workers"):
        Evaluator(workers=-1)


@pytest.mark.parametrize("workers", [1, 2])
def test_long_jobs_come_as_they_are_done(workers: int) -> None:
    assert sorted(in_parallel(abs, [-3, 1, -2], workers, "processes", ordered=False)) == [1, 2, 3]
    assert list(in_parallel(abs, [-3, 1, -2], workers, "processes")) == [3, 1, 2]
    assert list(in_parallel(abs, [], workers, "processes", ordered=False)) == []
