"""Distinct candidates: how different, how good, and what happens when too few are."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from treefit.distinct import LEAST, Distinct, Look, choose, looks
from treefit.fit import aim
from treefit.objective import Objective, Score
from treefit.plant.characteristics import Characteristics
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


def test_no_choice_ever_breaks_the_rules(line: Objective) -> None:
    rng = np.random.default_rng(5)
    for _ in range(200):
        places, scores = rng.random(8).round(2), -np.sort(-rng.uniform(0.8, 0.9, 8))
        ranked = [look(score, place) for score, place in zip(scores.tolist(), places.tolist(), strict=True)]
        chosen = choose(line, ranked, int(rng.integers(1, 6)), WISH)
        assert chosen[0] is ranked[0]
        assert told(chosen) == sorted(told(chosen), reverse=True)
        assert chosen[-1].score.total >= (1 - WISH.within) * ranked[0].score.total
        for one, two in combinations(chosen, 2):
            assert min(one.apart(two, line)) >= WISH.relaxed()[-1].genome >= LEAST
