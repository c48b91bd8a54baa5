"""Runners-up: where they begin, how far from the best they keep, what they cost, and that runs come out the same."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from tests.search.settings import cma_es
from treefit.apart import Apart
from treefit.distinct import Distinct, Look, choose, looks
from treefit.evaluation import Evaluator
from treefit.fit import Result, aim, fit
from treefit.objective import Objective, Score
from treefit.plant.characteristics import Characteristics
from treefit.progress import Failure, Generation
from treefit.racing import Seeds
from treefit.regrowth import Regrowth
from treefit.runners_up import RunnersUp, Told, strangers
from treefit.search import CMAES, Hints
from treefit.search.optimizer import Genomes
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView
from treefit.watch import Watch

WISH = Distinct(image=0.05, within=0.1, genome=0.12)


@pytest.fixture(scope="module")
def goal() -> Objective:
    wishes = Characteristics(vertices=400)
    return aim(blob(), SimpleGen(), PaperSimilarity(), wishes, OrthographicView(64), 0)


@pytest.fixture(scope="module")
def ranked(goal: Objective) -> list[Look]:
    """What a short search came to."""
    search = cma_es(evaluations=2000, min_population=16, generations=10_000).begin(len(goal.space), 0)
    evaluate = Evaluator("serial")
    while not search.done:
        search.tell(np.array([score.total for score in evaluate(goal, search.ask())]))
    return looks(goal, search.best(64)[0])


class Count:
    """Hears of batches."""

    def __init__(self) -> None:
        self.plants, self.stages = 0, list[str]()

    def __call__(self, stage: str) -> Told:
        self.stages.append(stage)

        def told(genomes: Genomes, scores: list[Score], plants: int) -> None:
            assert len(genomes) == len(scores)
            self.plants += plants

        return told


def runners(goal: Objective, seeds: int = 1) -> RunnersUp:
    evaluator = Evaluator("serial")
    watch, regrowth = Watch.of(goal.generator, evaluator), Regrowth(goal)
    return RunnersUp(goal, WISH, Hints.none(len(goal.space)), evaluator, Seeds(seeds), watch, regrowth)


def test_runners_up_keep_the_wished_distance_and_are_nearly_as_good(goal: Objective, ranked: list[Look]) -> None:
    count = Count()
    known = runners(goal).added(ranked, 3, 2000, count)
    assert count.plants == 2000
    assert count.stages == ["candidate 2", "candidate 3"]
    chosen = choose(goal, known, 3, WISH)
    assert len(chosen) == 3
    assert chosen[-1].score.total >= (1 - WISH.within) * chosen[0].score.total
    for one, two in combinations(chosen, 2):
        image, genome = one.apart(two, goal)
        assert image >= WISH.image
        assert genome >= WISH.genome
    assert chosen[0].score.total >= ranked[0].score.total  # the best is lost to a better one only


@pytest.mark.parametrize("plants", [0, 1, 7, 40])
def test_few_plants_are_not_overspent_and_take_nothing_away(goal: Objective, ranked: list[Look], plants: int) -> None:
    count = Count()
    known = runners(goal).added(ranked, 3, plants, count)
    assert count.plants <= plants
    assert known[0].score.total >= ranked[0].score.total
    assert {one.genome.tobytes() for one in ranked} <= {one.genome.tobytes() for one in known}


def test_strangers_have_genes_of_the_best_and_of_another_by_the_reach() -> None:
    hints = replace(Hints.none(40), guess=np.ones((3, 40)))
    for reach in (1.0, 0.5):
        found = strangers(np.zeros(40), hints, 3, reach, np.random.default_rng(0))
        for child, far in zip(found, (reach, reach / 2, reach), strict=True):
            assert set(child) == {0.0, far}
            assert (np.diff(child) != 0).sum() == 1  # one block of each


def test_strangers_are_uniform_where_nothing_is_suggested() -> None:
    found = strangers(np.full(40, 0.5), Hints.none(40), 30, 1.0, np.random.default_rng(0))
    assert found.shape == (30, 40)
    assert ((found >= 0) & (found <= 1)).all()
    assert len(np.unique(found, axis=0)) == 30


def test_the_nearer_to_what_is_chosen_the_lower_the_score(goal: Objective, ranked: list[Look]) -> None:
    apart = Apart.of(goal, ranked[:1], Distinct(image=0.3, genome=0.3))
    assert apart(ranked[0].genome).total == 0
    other = next(one for one in ranked[1:] if min(one.apart(ranked[0], goal)) < 0.3)
    assert 0 < apart(other.genome).total < other.score.total
    assert apart(other.genome).total == pytest.approx(apart.of_look(other))
    assert Apart.of(goal, ranked[:1], Distinct(0.001, 0.1, 0.001))(other.genome).total == other.score.total


def searched(share: float, **changes: Any) -> Result:
    settings: dict[str, Any] = {"candidates": 3, "runners_up": share, "other_seeds": 0, **changes}
    return fit(blob(), SimpleGen(), optimizer=CMAES(evaluations=1000), view=OrthographicView(64),
               similarity=PaperSimilarity(), characteristics=Characteristics(vertices=400), **settings)  # fmt: skip


def outcome(result: Result) -> list[object]:
    return [*(one.genome.tobytes() for one in result.candidates),
            *((line.stage, line.evaluations, line.best) for line in result.history)]  # fmt: skip


def test_a_fit_keeps_its_budget_and_tells_of_its_runners_up() -> None:
    result = searched(0.2)
    assert result.evaluations == 1000
    assert {line.stage for line in result.history} >= {"candidate 2", "candidate 3"}
    assert result.history[-1].best == result.candidates[0].score.total


def test_one_candidate_has_no_runner_up_and_the_whole_budget() -> None:
    assert outcome(searched(0.2, candidates=1)) == outcome(searched(0.0, candidates=1))


def test_workers_do_not_change_runners_up() -> None:
    serial, threads = (searched(0.2, evaluator=Evaluator(*how)) for how in (("serial",), ("threads", 2, 3)))
    assert outcome(serial) == outcome(threads)


def test_a_fit_killed_among_its_runners_up_ends_with_the_same_bytes(tmp_path: Path) -> None:
    def killed(now: Generation, failures: list[Failure]) -> None:
        if now.stage == "candidate 3":
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        searched(0.2, checkpoint=tmp_path / "c.npz", on_generation=killed)
    assert outcome(searched(0.2, checkpoint=tmp_path / "c.npz")) == outcome(searched(0.2))
