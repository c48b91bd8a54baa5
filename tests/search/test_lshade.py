from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from treefit.search import LSHADE
from treefit.search.lshade import Memory, _trials, population_at

SMALL = LSHADE(evaluations=4000, population=60)


def rng() -> np.random.Generator:
    return np.random.default_rng(0)


def test_the_population_shrinks_linearly_to_its_least() -> None:
    sizes = [population_at(SMALL, told) for told in (0, 1000, 2000, 4000)]
    assert sizes == [60, 46, 32, 4]
    search, asked = SMALL.begin(6, 0), []
    while not search.done:
        asked.append((search.told, len(search.ask())))
        search.tell(rng().random(asked[-1][1]))
    assert [size for _, size in asked[2:-1]] == [population_at(SMALL, told) for told, _ in asked[2:-1]]
    assert asked[-2][1] == 4


def test_memory_takes_the_lehmer_means_of_what_worked_into_one_entry_after_another() -> None:
    memory = Memory(np.full(2, 0.5), np.full(2, 0.5))
    memory.learn(np.array([0.2, 0.8]), np.array([1.0, 0.5]), np.array([1.0, 3.0]))
    assert memory.crossover.tolist() == [pytest.approx((0.04 + 3 * 0.64) / (0.2 + 2.4)), 0.5]
    assert memory.factor.tolist() == [pytest.approx((1 + 0.75) / (1 + 1.5)), 0.5]
    memory.learn(np.ones(1), np.ones(1), np.ones(1))
    assert memory.factor[1] == memory.crossover[1] == 1
    assert memory.at == 0


def test_memory_stays_when_nothing_worked() -> None:
    memory = Memory(np.full(2, 0.5), np.full(2, 0.5))
    memory.learn(np.empty(0), np.empty(0), np.empty(0))
    assert (memory.at, memory.factor.tolist()) == (0, [0.5, 0.5])


def test_a_crossover_rate_of_zero_that_worked_stays_for_good() -> None:
    memory = Memory(np.full(1, 0.5), np.full(1, 0.5))
    memory.learn(np.zeros(2), np.ones(2), np.ones(2))
    memory.learn(np.ones(2), np.ones(2), np.ones(2))
    assert set(memory.draw(100, rng())[0]) == {0.0}


def test_draws_are_around_the_memory_and_in_their_ranges() -> None:
    crossover, factor = Memory(np.full(3, 0.3), np.full(3, 0.6)).draw(20_000, rng())
    assert 0 <= crossover.min() <= crossover.max() <= 1
    assert 0 < factor.min() <= factor.max() == 1
    assert [np.median(crossover), np.median(factor)] == [pytest.approx(0.3, abs=0.01), pytest.approx(0.6, abs=0.03)]


def test_memory_adapts_to_a_hill_whose_genes_pull_on_each_other() -> None:
    """Along a turned ridge genes must be taken over together: the crossover rate rises."""
    axes = np.linalg.qr(rng().normal(size=(10, 10)))[0]
    memory, genomes = Memory(np.full(6, 0.5), np.full(6, 0.5)), rng().random((100, 10))
    draws = rng()

    def score(genomes: np.ndarray) -> np.ndarray:
        return -(((genomes - 0.5) @ axes) ** 2 * 10 ** (3 * np.arange(10) / 9)).sum(axis=1)

    scores = score(genomes)
    for _ in range(60):
        crossover, factor = memory.draw(100, draws)
        trials = _trials(genomes, scores, genomes[:0], crossover, factor, 0.11, draws)
        better = (results := score(trials)) > scores
        memory.learn(crossover[better], factor[better], (results - scores)[better])
        genomes, scores = np.where(better[:, None], trials, genomes), np.maximum(scores, results)
    assert np.nanmean(memory.crossover) > 0.6


def test_a_trial_keeps_the_genes_that_are_not_crossed_and_changes_one_at_least() -> None:
    genomes = rng().random((50, 8))
    trials = _trials(genomes, rng().random(50), rng().random((20, 8)), np.zeros(50), np.full(50, 0.5), 0.1, rng())
    assert ((trials != genomes).sum(axis=1) == 1).all()
    trials = _trials(genomes, rng().random(50), rng().random((20, 8)), np.ones(50), np.ones(50), 0.1, rng())
    assert 0 <= trials.min() <= trials.max() <= 1


@pytest.mark.parametrize("outlived", [0, 3])
def test_the_three_that_make_a_step_differ(outlived: int) -> None:
    """With four individuals of one gene each every step can be told: best - own + first - second, all of them other."""
    genomes, others = 0.4 + np.array([[0.001], [0.002], [0.004], [0.008]]), 0.4 + 0.016 * np.ones((outlived, 1))
    everyone = np.concatenate([genomes, others])
    draws = rng()
    for _ in range(200):
        trials = _trials(genomes, np.arange(4.0), others, np.ones(4), np.ones(4), 0.1, draws)
        for i, trial in enumerate(trials):
            steps = [
                genomes[best] + genomes[first] - everyone[second]
                for best in (2, 3) for first in range(4) if first != i
                for second in range(len(everyone)) if second not in (i, first)
            ]  # fmt: skip
            assert np.abs(np.array(steps) - trial).min() < 1e-12


def test_a_turned_ridge_is_climbed() -> None:
    axes = np.linalg.qr(rng().normal(size=(8, 8)))[0]
    search = replace(SMALL, evaluations=12_000).begin(8, 0)
    while not search.done:
        search.tell(1 - ((((search.ask() - 0.4) @ axes) ** 2) * 10 ** (2 * np.arange(8) / 7)).sum(axis=1))
    assert search.best(1)[1][0] > 1 - 1e-6


@pytest.mark.parametrize("field", ["evaluations", "population", "memory", "best_share", "archive_share"])
def test_settings_out_of_range_are_refused(field: str) -> None:
    with pytest.raises(ValueError, match=field):
        LSHADE(**{field: -1})
