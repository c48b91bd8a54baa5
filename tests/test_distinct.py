"""Distinct candidates: how different, how good, and what happens when too few are."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from treefit.distinct import LEAST, Distinct, Look, choose, genome_distance, looks
from treefit.evaluation import Evaluator
from treefit.fit import Result, aim, fit
from treefit.objective import Objective, Score
from treefit.plant.characteristics import Characteristics
from treefit.search import CMAES
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView

WISH = Distinct(image=0.2, within=0.1, genome=0.1)


@dataclass(frozen=True)
class Places:
    """A similarity of numbers: 1 less their distance."""

    def describe(self, bits: Any) -> Any:
        return bits

    def compare(self, target: Any, plant: Any) -> float:
        return max(0.0, 1.0 - abs(float(target) - float(plant)))


@pytest.fixture
def goal() -> Objective:
    return aim(blob(), SimpleGen(), PaperSimilarity(), Characteristics(), OrthographicView(64), 0)


@pytest.fixture
def line(goal: Objective) -> Objective:
    return Objective(goal.generator, goal.space, goal.view, goal.frame, Places(), 0.0, goal.characteristics, 0,
                     goal.budget)  # fmt: skip


def look(score: float, place: float, gene: float | None = None) -> Look:
    return Look(np.full(4, place if gene is None else gene), Score(score), place)


def told(chosen: list[Look]) -> list[float]:
    return [one.score.total for one in chosen]


def test_candidates_are_apart_in_mask_and_genome_and_the_best_of_such(line: Objective) -> None:
    ranked = [look(0.9, 0.0), look(0.89, 0.1), look(0.88, 0.25), look(0.87, 0.5, 0.3), look(0.86, 0.5)]
    assert told(choose(line, ranked, 3, WISH)) == [0.9, 0.88, 0.86]


def test_none_is_further_under_the_best_than_wished_though_fewer_are_left(
    line: Objective, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        assert told(choose(line, [look(0.9, 0.0), look(0.82, 0.5), look(0.8, 0.9)], 3, WISH)) == [0.9, 0.82]
    assert caplog.messages == ["2 of 3 candidates: nothing else that is different was within 10 % of the best score"]


def test_the_distance_is_halved_rather_than_candidates_left_out_and_it_is_said(
    line: Objective, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        assert told(choose(line, [look(0.9, 0.0), look(0.89, 0.06), look(0.88, 0.12)], 2, WISH)) == [0.9, 0.88]
    assert caplog.messages == ["the candidates look 0.12 apart, not 0.20: no others were within 10 % of the best score"]


@pytest.mark.parametrize("image", [0.0, 0.2])
def test_a_tree_is_never_its_own_runner_up(line: Objective, image: float) -> None:
    twins = [look(0.9, 0.3), look(0.9, 0.3), look(0.9, 0.3 + LEAST / 2), look(0.9, 0.9, 0.3)]
    assert len(choose(line, twins, 3, Distinct(image, genome=0.0))) == 1


def test_looks_are_sorted_and_without_what_cannot_be_scored(goal: Objective) -> None:
    genomes = np.random.default_rng(0).random((6, len(goal.space)))
    found = looks(goal, genomes)
    assert told(found) == sorted((goal(genome).total for genome in genomes if goal(genome).total > 0), reverse=True)


def searched(share: float, **changes: Any) -> Result:
    settings: dict[str, Any] = {"candidates": 3, "runners_up": share, "other_seeds": 0, **changes}
    return fit(blob(), SimpleGen(), optimizer=CMAES(evaluations=1000), view=OrthographicView(64),
               similarity=PaperSimilarity(), characteristics=Characteristics(vertices=400), **settings)  # fmt: skip


def test_runners_up_are_found_within_the_budget_apart_and_nearly_as_good(goal: Objective) -> None:
    result = searched(0.2)
    assert result.evaluations == 1000
    assert {line.stage for line in result.history[-3:]} <= {"candidate 2", "candidate 3"}
    scores = [found.score.total for found in result.candidates]
    assert len(scores) == 3
    assert scores == sorted(scores, reverse=True)
    assert scores[2] >= 0.95 * scores[0]
    apart = [genome_distance(one.genome, two.genome) for one in result.candidates for two in result.candidates
             if one is not two]  # fmt: skip
    assert min(apart) >= LEAST
    assert result.history[-1].best == scores[0]


def test_one_candidate_has_no_runner_up_and_the_whole_budget() -> None:
    alone, none = searched(0.2, candidates=1), searched(0.0, candidates=1)
    assert [line.stage for line in alone.history] == [line.stage for line in none.history]
    assert alone.candidates[0].genome.tobytes() == none.candidates[0].genome.tobytes()


def test_workers_do_not_change_runners_up() -> None:
    serial, threads = (searched(0.2, evaluator=Evaluator(*how)) for how in (("serial",), ("threads", 2, 3)))
    assert [one.genome.tobytes() for one in serial.candidates] == [one.genome.tobytes() for one in threads.candidates]
