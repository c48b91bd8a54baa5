"""Contract that every optimiser passes."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest

from tests.search.settings import cma_es, settings
from treefit.search import (
    CMAES,
    LSHADE,
    DifferentialEvolution,
    Hints,
    Optimizer,
    PyCMA,
    RandomSearch,
    Strategy,
    TreeGA,
)

STRATEGIES: dict[str, Strategy] = {
    "tree_ga": TreeGA(evaluations=1500, population=20, start_population=30, generations=10),
    "uniform": TreeGA(evaluations=1500, population=20, start_population=30, generations=10, crossover="uniform"),
    "authors": TreeGA(
        evaluations=1500, population=20, start_population=25, generations=10, start_tries=10, fitness_growth=0.1,
        fitness_least=1e-4, crossover="uniform", mutation_always=4, mutation_genes=0.15, mutation_count="uniform",
        rate_floor=0.05, tries=1,
    ),
    "ga": TreeGA(evaluations=1500, population=40, start_population=40, depth=1, guided=False, tries=1),
    "lshade": LSHADE(evaluations=900, population=30),
    "cma": PyCMA(evaluations=480, population=16),
    "de": DifferentialEvolution(evaluations=900, population=30),
    "cma_es": cma_es(evaluations=1500, start_share=0.3, generations=80, min_population=8),
    "treefit": CMAES(**{**settings("treefit"), "evaluations": 1500}),
    "random": RandomSearch(evaluations=1500, batch=70),
}  # fmt: skip
KNOWN = np.random.default_rng(5).random((7, 8))


@pytest.fixture(params=[None, KNOWN], ids=["unknown", "known"])
def known(request: pytest.FixtureRequest) -> np.ndarray | None:
    """Genomes to begin from."""
    genomes: np.ndarray | None = request.param
    return genomes


@pytest.fixture(params=STRATEGIES)
def strategy(request: pytest.FixtureRequest) -> Strategy:
    return STRATEGIES[request.param]


def hints(known: np.ndarray | None) -> Hints | None:
    """Hints with the genomes `known`, rates, marks and a guess; none without."""
    if known is None:
        return None
    rng, n = np.random.default_rng(3), known.shape[1]
    rate, quality = rng.random(n), rng.normal(size=(n, 5))
    return replace(Hints.none(n), known=known, rate=rate, quality=quality, guess=rng.random((9, n)))


def hill(genomes: np.ndarray) -> np.ndarray:
    """Score with one peak at 0.3 in every gene."""
    return np.exp(-((genomes - 0.3) ** 2).sum(axis=1))


def run(search: Optimizer, steps: int = 10**6) -> list[np.ndarray]:
    asked = []
    while not search.done and steps > 0:
        asked.append(search.ask())
        search.tell(hill(asked[-1]))
        steps -= 1
    return asked


class Whole(NamedTuple):
    """What a search asked, and its best 5 genomes with their scores."""

    asked: list[np.ndarray]
    genomes: np.ndarray
    scores: np.ndarray


@pytest.fixture
def whole(strategy: Strategy, known: np.ndarray | None) -> Whole:
    """The search with seed 1."""
    return _whole(strategy, known is not None)


@cache
def _whole(strategy: Strategy, knows: bool) -> Whole:
    search = strategy.begin(8, 1, hints(KNOWN if knows else None))
    return Whole(run(search), *search.best(5))


def test_exactly_the_budget_is_asked(strategy: Strategy, whole: Whole) -> None:
    assert sum(len(genomes) for genomes in whole.asked) == strategy.evaluations


@pytest.mark.parametrize("evaluations", [1, 7, 33, 111, 999])
def test_odd_budgets_are_kept_too(evaluations: int) -> None:
    search = TreeGA(evaluations=evaluations, population=20, start_population=30, generations=10).begin(8, 1)
    assert sum(len(genomes) for genomes in run(search)) == evaluations
    assert len(search.best(3)[0]) >= 1


def test_genomes_are_in_the_unit_cube(whole: Whole) -> None:
    for genomes in whole.asked:
        assert genomes.shape[1] == 8
        assert 0 <= genomes.min() <= genomes.max() <= 1


def test_the_same_seed_asks_the_same_and_another_does_not(
    strategy: Strategy, known: np.ndarray | None, whole: Whole
) -> None:
    again, other = (np.concatenate(run(strategy.begin(8, seed, hints(known)))) for seed in (1, 2))
    assert np.concatenate(whole.asked).tobytes() == again.tobytes() != other.tobytes()


def test_the_best_is_the_best_that_was_told(whole: Whole) -> None:
    assert whole.scores[0] == hill(np.concatenate(whole.asked)).max()
    np.testing.assert_allclose(hill(whole.genomes), whole.scores)


@pytest.mark.parametrize("steps", [1, 3, 12, 20])
def test_a_restored_search_goes_on_as_if_never_stopped(
    strategy: Strategy, known: np.ndarray | None, whole: Whole, steps: int
) -> None:
    part, again = (strategy.begin(8, 1, hints(known)) for _ in range(2))
    run(part, steps)
    again.restore(part.state())
    rest = run(again)
    assert np.concatenate(rest).tobytes() == np.concatenate(whole.asked[steps:]).tobytes()
    assert again.best(5)[0].tobytes() == whole.genomes.tobytes()


def test_scores_at_or_under_the_floors_make_no_difference(strategy: Strategy, known: np.ndarray | None) -> None:
    """Whatever is told in their place, and also when the search is stopped and restored now and then."""
    exact, rough = strategy.begin(8, 1, hints(known)), strategy.begin(8, 1, hints(known))
    rng, lowered = np.random.default_rng(2), 0
    while not exact.done:
        genomes, again = exact.ask(), rough.ask()
        assert genomes.tobytes() == again.tobytes()
        floors, scores = rough.floors(), hill(genomes)
        assert floors.tobytes() == exact.floors().tobytes()
        lowered += int((scores <= floors).sum())
        exact.tell(scores)
        rough.tell(np.where(scores <= floors, rng.choice([0.0, 0.9], len(floors)) * np.maximum(floors, 0), scores))
        kept, other = exact.state(), rough.state()
        assert all(kept[name].tobytes() == other[name].tobytes() for name in kept)
        if rng.random() < 0.3:
            rough = strategy.begin(8, 1, hints(known))
            rough.restore(other)
    assert lowered > 50 or (floors <= 0).all()


def test_floors_fail_before_ask(strategy: Strategy) -> None:
    with pytest.raises(ValueError, match="ask for genomes first"):
        strategy.begin(8, 1).floors()


def test_ask_fails_when_called_twice(strategy: Strategy) -> None:
    search = strategy.begin(8, 1)
    search.ask()
    with pytest.raises(ValueError, match="tell the scores"):
        search.ask()


def test_tell_fails_for_another_count_of_scores(strategy: Strategy) -> None:
    search = strategy.begin(8, 1)
    search.ask()
    with pytest.raises(ValueError, match="one score for each"):
        search.tell(np.zeros(3))


def test_the_tree_of_gas_beats_random_search() -> None:
    tree, random = STRATEGIES["tree_ga"].begin(8, 1), STRATEGIES["random"].begin(8, 1)
    run(tree), run(random)
    assert tree.best(1)[1][0] > random.best(1)[1][0] + 0.05
