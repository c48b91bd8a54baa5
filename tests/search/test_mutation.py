from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from treefit.search.hints import Hints
from treefit.search.mutation import Guide, guide, mutate

RATE = np.array([0.1, 0.2, 0.3, 0.4, 0.0, 1.0])
MARKS = np.random.default_rng(3).normal(size=(6, 10))
NO_MARKS = np.zeros((6, 1))


def rng() -> np.random.Generator:
    return np.random.default_rng(0)


def mutants(by: Guide, count: int, m: int = 4000, value: float = 0.55) -> np.ndarray:
    return mutate(np.full((m, len(by.weights)), value), np.full(m, count), by, rng())


def quality(genomes: np.ndarray) -> np.ndarray:
    return replace(Hints.none(6), quality=MARKS).mark(genomes)


def test_a_gene_changes_in_proportion_to_its_rate() -> None:
    """And one of no rate never."""
    changed = (mutants(guide(RATE, NO_MARKS, 0.0, 500), 1, 40_000) != 0.55).mean(axis=0)
    np.testing.assert_allclose(changed, RATE / 2, atol=0.01)


@pytest.mark.parametrize("tries", [1, 3])
def test_further_genes_are_drawn_in_proportion_to_the_rates_of_those_left(tries: int) -> None:
    """Of all pairs i then j: p_i p_j / (1 - p_i), and the other way round."""
    marks = np.zeros((6, 2)) if tries == 1 else np.array([[1e-9, 0]] * 6)  # of no weight, but they make more tries
    changed = mutants(guide(RATE, marks, 0.0, tries), 2, 40_000, 0.25) != 0.25
    share = RATE / RATE.sum()
    for i in range(6):
        for j in range(i):
            wanted = share[i] * share[j] * (1 / (1 - share[i]) + 1 / (1 - share[j]))
            assert (changed[:, i] & changed[:, j]).mean() == pytest.approx(wanted, abs=0.012)


def test_rates_count_as_the_floor_at_least_and_none_leave_all_genes_alike() -> None:
    np.testing.assert_allclose(guide(RATE, NO_MARKS, 0.5, 1).weights, np.array([5, 5, 5, 5, 5, 10]) / 35)
    np.testing.assert_allclose(guide(np.zeros(6), NO_MARKS, 0.0, 1).weights, 1 / 6)


@pytest.mark.parametrize("tries", [1, 50])
@pytest.mark.parametrize("count", [0, 1, 3, 5])
def test_exactly_the_wanted_count_of_genes_changes(count: int, tries: int) -> None:
    assert set((mutants(guide(RATE, MARKS, 0.0, tries), count, 300) != 0.55).sum(axis=1)) == {count}


def test_no_more_genes_change_than_have_a_rate() -> None:
    assert set((mutants(guide(RATE, MARKS, 0.0, 5), 6, 300) != 0.55).sum(axis=1)) == {5}


def test_each_genome_has_its_own_count() -> None:
    counts = np.arange(500) % 5
    changed = mutate(np.full((500, 6), 0.55), counts, guide(RATE, MARKS, 0.0, 20), rng()) != 0.55
    assert changed.sum(axis=1).tolist() == counts.tolist()


def test_values_are_uniform_where_the_marks_say_nothing() -> None:
    drawn = mutants(guide(np.ones(6), np.ones((6, 10)), 0.0, 500), 1, 20_000)
    values = drawn[drawn != 0.55]
    assert len(values) == 20_000
    np.testing.assert_allclose(np.histogram(values, 20, (0, 1))[0] / 20_000, 0.05, atol=0.006)


def test_values_are_uniform_with_marks_and_one_try() -> None:
    drawn = mutants(guide(np.ones(6), MARKS, 0.0, 1), 1, 20_000)
    np.testing.assert_allclose(np.histogram(drawn[drawn != 0.55], 20, (0, 1))[0] / 20_000, 0.05, atol=0.006)


def test_marks_that_are_all_alike_cannot_tell_tries_apart() -> None:
    assert guide(RATE, np.full((6, 10), 2.0), 0.0, 500).tries == 1
    assert guide(RATE, MARKS, 0.0, 500).tries == 500


def test_more_tries_lead_to_a_higher_quality() -> None:
    means = [quality(mutants(guide(np.ones(6), MARKS, 0.0, tries), 2, 500)).mean() for tries in (1, 5, 50, 500)]
    assert (np.diff(means) > 0.5).all()


def test_the_try_with_the_highest_quality_is_taken() -> None:
    """Of 500 tries with one of six genes in one of ten parts hardly any misses the best of the sixty."""
    old = np.full((1, 6), 0.55)
    gains = MARKS - MARKS[:, 5:6]
    gained = quality(mutants(guide(np.ones(6), MARKS, 0.0, 500), 1, 500)) - quality(old)
    assert (gained > gains.max() - 1e-5).mean() > 0.99


def test_mutants_stay_in_the_unit_interval_and_the_genomes_as_they_are() -> None:
    genomes = rng().random((1000, 6))
    before = genomes.copy()
    mutated = mutate(genomes, np.full(1000, 5), guide(RATE, MARKS, 0.0, 10), rng())
    assert 0 <= mutated.min() <= mutated.max() <= 1
    np.testing.assert_array_equal(genomes, before)
