"""Racing: who is scored on how many seeds, what is told, and what a fit of a species comes to."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from tests.failing import Failing
from treefit.evaluation import Evaluator
from treefit.fit import Result, aim, fit
from treefit.objective import Objective, Score, mean_score
from treefit.plant import Generator
from treefit.plant.characteristics import Characteristics
from treefit.progress import Failure, Generation
from treefit.racing import Seeds, race, raced
from treefit.search import CMAES
from treefit.search.optimizer import Genomes, Scores
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView

SEEDS = (7, 11, 12, 13, 14)


def noisy(rows: Genomes, floors: Scores) -> list[Score]:
    """Score of a genome of one gene, by luck off by up to 0.1 on a seed."""
    luck = [np.random.default_rng([int(row[0] * 1e9), int(row[1])]).uniform(-0.1, 0.1) for row in rows]
    return [Score(float(row[0] + by)) for row, by in zip(rows, luck, strict=True)]


def objective(seeds: Seeds, generator: Generator | None = None) -> Objective:
    wishes = Characteristics(vertices=400)
    aimed = aim(blob(), generator or SimpleGen(), PaperSimilarity(), wishes, OrthographicView(64), 3)
    return replace(aimed, further_seeds=seeds.further(3))


def small(folder: Path | None = None, seeds: Seeds | None = None, **changes: object) -> Result:
    settings: dict[str, object] = {
        "optimizer": CMAES(evaluations=400), "characteristics": Characteristics(vertices=400), "candidates": 2,
        "similarity": PaperSimilarity(), "view": OrthographicView(64), "other_seeds": 2,
        "evaluator": Evaluator("serial"), **changes,
    }  # fmt: skip
    checkpoint = None if folder is None else folder / "c.npz"
    return fit(blob(), SimpleGen(), seeds=seeds or Seeds(3), checkpoint=checkpoint, **settings)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("count", "rounds", "plants"),
    [(1, [(1, 1)], 1), (2, [(1, 1), (4, 2)], 1.25), (3, [(1, 1), (2, 2), (4, 3)], 1.75),
     (5, [(1, 1), (2, 3), (4, 5)], 2.5)],
)  # fmt: skip
def test_the_better_half_goes_on_to_half_of_the_seeds_and_the_best_quarter_to_all(
    count: int, rounds: list[tuple[int, int]], plants: float
) -> None:
    assert Seeds(count).rounds == rounds
    assert Seeds(count).plants == plants
    assert Seeds(count, racing=False).plants == count


def test_the_further_seeds_are_none_of_those_that_candidates_are_tested_on() -> None:
    for seed in (0, 5):
        assert not {seed, *range(seed + 1, seed + 1001)} & set(Seeds(100).further(seed))


@pytest.mark.parametrize("count", [2, 3, 5])
def test_who_went_further_is_told_more_and_who_went_to_the_end_the_mean(count: int) -> None:
    genomes, seeds = np.random.default_rng(count).random((40, 1)), Seeds(count)
    told, plants = race(noisy, genomes, SEEDS[:count], seeds.rounds)
    assert plants == 40 * seeds.plants
    totals = np.array([score.total for score in told])
    means = np.array([np.mean([noisy(np.array([[*g, j]]), np.zeros(1))[0].total for j in range(count)])
                      for g in genomes])  # fmt: skip
    exact = np.isclose(totals, means, rtol=0, atol=1e-12)
    assert exact.sum() == 10
    assert totals[exact].min() > totals[~exact].max()
    assert genomes[exact].mean() > np.sort(genomes, axis=0)[-20:].mean()


def test_a_group_that_stops_early_keeps_its_order() -> None:
    genomes = np.random.default_rng(1).random((40, 1)) / 2 + 0.4
    told, _ = race(noisy, genomes, SEEDS[:3], Seeds(3).rounds)
    first = np.array([score.total for score in noisy(np.hstack([genomes, np.zeros((40, 1))]), np.zeros(40))])
    worst = np.argsort(first)[:20]
    assert (np.diff([told[i].total for i in worst]) > 0).all()


def test_without_racing_the_mean_of_all_seeds_is_told() -> None:
    goal, seeds = objective(Seeds(3)), Seeds(3, racing=False)
    genomes = np.random.default_rng(0).random((6, len(goal.space)))
    with raced(Evaluator("threads", 2, 2), goal, seeds) as batch:
        told, plants = batch(genomes, np.full(6, 0.99))
    assert plants == 18
    assert told == [goal.mean(genome) for genome in genomes]
    on = [goal.on(seed)(genomes[0]).total for seed in (3, 1004, 1005)]
    assert told[0].total == pytest.approx(np.mean(on))


def test_a_mean_names_the_failure_with_its_seed() -> None:
    mean = mean_score([Score(0.6, 0.8, {"height": 0.75}), Score(0.0, failure="RuntimeError: rot")], (4, 5))
    assert mean == Score(0.3, 0.4, {"height": 0.375}, "RuntimeError: rot (seed 5)")


def test_failures_race_along_and_are_told_as_nothing() -> None:
    goal = objective(Seeds(2), Failing(0.5))
    genomes = np.random.default_rng(0).random((16, len(goal.space)))
    with raced(Evaluator("serial"), goal, Seeds(2)) as batch:
        told, _ = batch(genomes, np.zeros(16))
    assert 0 < sum(score.failure is not None for score in told) < 16
    assert all(score.total == 0 for score in told if score.failure)


def test_a_fit_of_a_species_spends_no_more_plants_than_it_may_and_tells_the_mean() -> None:
    result = small()
    assert 370 <= result.evaluations <= 400
    best, goal = result.candidates[0], replace(objective(Seeds(3)), seed=0, further_seeds=Seeds(3).further(0))
    assert best.seeds == 3
    assert best.score_other_seeds is not None
    assert goal.seeds == (0, 1001, 1002)
    assert best.score == goal.mean(best.genome)
    assert result.history[-1].best == best.score.total
    assert small(seeds=Seeds(1)).candidates[0].seeds == 1


def test_workers_and_a_kill_do_not_change_a_race(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def kill(now: Generation, failures: list[Failure]) -> None:
        if now.number == 4:
            raise KeyboardInterrupt

    monkeypatch.setattr(sys.modules["treefit.fit"], "CHECKPOINT_SECONDS", 0.0)
    with pytest.raises(KeyboardInterrupt):
        small(tmp_path, on_generation=kill)
    resumed, whole = small(tmp_path), small(evaluator=Evaluator("threads", 2, 3))
    assert [one.genome.tobytes() for one in resumed.candidates] == [one.genome.tobytes() for one in whole.candidates]
    assert [one.score for one in resumed.candidates] == [one.score for one in whole.candidates]
    lines = ([(line.stage, line.evaluations, line.best, line.mean) for line in one.history] for one in (resumed, whole))
    assert next(lines) == next(lines)
