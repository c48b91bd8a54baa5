from __future__ import annotations

import numpy as np

from treefit.search.operators import (
    TRIES,
    fittest,
    one_dot_crossover,
    pick_parents,
    uniform_crossover,
    without_twins,
)


def rng() -> np.random.Generator:
    return np.random.default_rng(0)


def test_parents_are_chosen_in_proportion_to_their_score() -> None:
    parents = pick_parents(np.array([1.0, 2.0, 3.0, 4.0]), 40_000, rng())
    share = np.bincount(parents[:, 0]) / 40_000
    np.testing.assert_allclose(share, [0.1, 0.2, 0.3, 0.4], atol=0.01)
    assert (parents[:, 0] != parents[:, 1]).all()


def test_fitness_is_a_power_of_the_score_and_what_is_added() -> None:
    parents = pick_parents(np.array([0.0, 1.0, 2.0]), 40_000, rng(), power=2.0, least=1.0)
    np.testing.assert_allclose(np.bincount(parents[:, 0]) / 40_000, np.array([1, 2, 5]) / 8, atol=0.01)


def test_a_score_of_zero_has_no_chance_to_come_first() -> None:
    assert set(pick_parents(np.array([0.0, 1.0, 3.0]), 1000, rng())[:, 0]) == {1, 2}


def test_scores_of_zero_leave_all_parents_alike() -> None:
    share = np.bincount(pick_parents(np.zeros(4), 40_000, rng())[:, 0]) / 40_000
    np.testing.assert_allclose(share, 0.25, atol=0.02)


def test_one_dot_crossover_changes_parent_once() -> None:
    children = one_dot_crossover(np.zeros((500, 6)), np.ones((500, 6)), rng())
    assert (np.abs(np.diff(children, axis=1)).sum(axis=1) == 1).all()
    assert set(children.sum(axis=1)) == {1, 2, 3, 4, 5}
    assert (children[:, 0] == 0).all()
    assert (children[:, -1] == 1).all()


def test_uniform_crossover_takes_every_gene_from_a_parent() -> None:
    children = uniform_crossover(np.zeros((2000, 6)), np.ones((2000, 6)), rng())
    np.testing.assert_allclose(children.mean(axis=0), 0.5, atol=0.05)


def test_the_fittest_come_best_first() -> None:
    genomes, scores = fittest(np.arange(5.0)[:, None], np.array([1.0, 5.0, 3.0, 5.0, 0.0]), 3)
    assert genomes.ravel().tolist() == [1, 3, 2]
    assert scores.tolist() == [5, 5, 3]


def test_only_twins_are_changed_and_no_twin_is_left() -> None:
    population, children = np.array([[1.0], [2.0]]), np.array([[3.0], [1.0], [3.0], [4.0], [2.0]])
    single = without_twins(children, population, lambda twins: twins + 0.5)
    assert single.ravel().tolist() == [3.0, 1.5, 3.5, 4.0, 2.5]


def test_a_twin_that_becomes_another_twin_is_changed_again() -> None:
    population = np.arange(float(TRIES))[:, None]
    assert without_twins(np.zeros((1, 1)), population, lambda twins: twins + 1).tolist() == [[TRIES]]


def test_twins_that_cannot_be_changed_are_kept() -> None:
    assert without_twins(np.zeros((3, 2)), np.zeros((1, 2)), lambda twins: twins).tolist() == [[0.0, 0.0]] * 3
