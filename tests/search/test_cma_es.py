from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tests.search.settings import cma_es
from tests.search.test_contract import hints
from treefit.search.cma_es import CMAESSearch
from treefit.search.gaussian import around, learn, rates
from treefit.search.operators import mirrored
from treefit.search.start import Start

SMALL = cma_es(evaluations=3000, start_share=0.1, min_population=16)
STRETCH = 10 ** (3 * np.arange(10) / 9)  # of the axes of the bowls: the longest is a thousand times the shortest


def run(search: CMAESSearch, score: Callable[[np.ndarray], np.ndarray]) -> CMAESSearch:
    while not search.done:
        search.tell(score(search.ask()))
    return search


@pytest.mark.parametrize("turned", [False, True])
def test_the_bottom_of_a_stretched_bowl_is_found_however_it_is_turned(turned: bool) -> None:
    axes = np.linalg.qr(np.random.default_rng(0).normal(size=(10, 10)))[0] if turned else np.eye(10)
    gaussian, rate, rng = around(np.full(10, 0.2), 0.25), rates(10, 12), np.random.default_rng(1)
    for _ in range(400):
        normals = rng.standard_normal((12, 10))
        apart = (gaussian.place(gaussian.steps(normals)) - 0.4) @ axes
        gaussian = learn(gaussian, rate, normals[np.argsort((STRETCH * apart**2).sum(axis=1))])
    np.testing.assert_allclose(gaussian.mean, 0.4, atol=1e-6)


def test_the_distribution_takes_the_shape_of_the_bowl() -> None:
    """Its spread is as the inverse root of the steepness, gene by gene."""
    gaussian, rate, rng = around(np.full(10, 0.2), 0.25), rates(10, 20), np.random.default_rng(1)
    for _ in range(200):
        normals = rng.standard_normal((20, 10))
        apart = gaussian.place(gaussian.steps(normals)) - 0.4
        gaussian = learn(gaussian, rate, normals[np.argsort((STRETCH * apart**2).sum(axis=1))])
    slope = np.polyfit(np.log(STRETCH), np.log(gaussian.spread), 1)[0]
    assert slope == pytest.approx(-0.5, abs=0.1)


def test_weights_fall_with_the_rank_and_those_of_the_better_half_sum_up_to_one() -> None:
    for population in (4, 7, 16, 50):
        rate = rates(12, population)
        assert rate.good.sum() == pytest.approx(1)
        for part in (rate.scale, rate.covariance):
            assert (np.diff(part.weights) < 0).all()
            assert part.weights[part.weights > 0].sum() == pytest.approx(1)
            assert part.one + part.many < 1


def test_a_peak_in_a_corner_is_found() -> None:
    corner = np.arange(8) % 2
    search = run(SMALL.begin(8, 0), lambda genomes: -((genomes - corner) ** 2).sum(axis=1) + 9)
    assert search.best(1)[1][0] > 9 - 1e-4


def test_mirrored_folds_any_coordinate_into_the_unit_interval() -> None:
    np.testing.assert_allclose(
        mirrored(np.array([[-0.3, 0.0, 0.2, 1.0, 1.2, 2.5, -1.4]])), [[0.3, 0, 0.2, 1, 0.8, 0.5, 0.6]]
    )


def test_only_the_order_of_the_scores_matters() -> None:
    asked = []
    for bent in (lambda s: s, np.exp):
        search, genomes = SMALL.begin(8, 0), []
        while not search.done:
            genomes.append(search.ask())
            search.tell(bent(2 - ((genomes[-1] - 0.3) ** 2).sum(axis=1)))
        asked.append(np.concatenate(genomes))
    assert asked[0].tobytes() == asked[1].tobytes()


def test_a_search_that_has_converged_starts_again_from_the_best_known() -> None:
    search = SMALL.begin(8, 0)
    while search.restarts == 0:
        search.tell(1 - ((search.ask() - 0.3) ** 2).mean(axis=1))
    assert search.gaussian is not None
    np.testing.assert_array_equal(search.gaussian.mean, search.best(1)[0][0])
    np.testing.assert_array_equal(search.gaussian.spread, np.full(8, SMALL.restart_step))


def test_the_population_follows_from_the_budget_and_the_random_start_comes_first() -> None:
    search = SMALL.begin(8, 0)
    sizes = []
    while not search.done:
        sizes.append(len(search.ask()))
        search.tell(np.ones(sizes[-1]))
    assert sizes[:3] == [100, 100, 100]
    assert set(sizes[3:-1]) == {16}
    assert len(cma_es(evaluations=50_000).begin(8, 0).rates.good) == 52


GROWING = cma_es(
    evaluations=3000, start_most=20, generations=10**5, min_population=8, max_population=8, growth=2.0, converged=0.05
)


def test_the_population_grows_each_time_that_it_starts_again_also_in_a_restored_search() -> None:
    search, asked = GROWING.begin(8, 0), {}
    while not search.done:
        genomes = search.ask()
        asked.setdefault(search.restarts, []).append(len(genomes))
        search.tell(1 - ((genomes - 0.3) ** 2).mean(axis=1))
        restored = GROWING.begin(8, 0)
        restored.restore(search.state())
        assert restored.population == search.population == 8 * 2**search.restarts
        assert len(restored.rates.good) == len(search.rates.good) == search.population
        search = restored
    assert asked[0][0] == 20
    for restarts, sizes in asked.items():
        assert set(sizes[restarts == 0 : -1]) <= {8 * 2**restarts}
    assert len(asked) > 3


def test_a_population_is_never_over_the_most_before_it_starts_again_nor_a_start_over_its_most() -> None:
    assert cma_es(evaluations=50_000, min_population=8, max_population=30).begin(8, 0).population == 30
    assert (
        cma_es(evaluations=50_000, min_population=30, max_population=30, generations=10**5).begin(8, 0).population == 30
    )
    assert [cma_es(evaluations=50_000, start_most=most).begin(8, 0).first for most in (70, 10**5)] == [70, 3000]


def test_a_least_population_over_the_most_is_refused() -> None:
    with pytest.raises(ValueError, match="must not be under min_population, 16, got 8"):
        cma_es(min_population=16, max_population=8)


@pytest.mark.parametrize(("start", "count", "step"), [
    ("random", 3, SMALL.step), ("mixed", 0, SMALL.step),
    ("mixed", 3, SMALL.known_step), ("presets", 3, SMALL.known_step), ("guess", 0, SMALL.known_step),
])  # fmt: skip
def test_a_first_population_led_by_known_genomes_is_followed_by_smaller_steps(
    start: Start, count: int, step: float
) -> None:
    search = replace(SMALL, start=start).begin(8, 0, hints(np.full((count, 8), 0.5)))
    while search.gaussian is None:
        search.tell(1 - ((search.ask() - 0.3) ** 2).mean(axis=1))
    np.testing.assert_array_equal(search.gaussian.mean, search.best(1)[0][0])
    np.testing.assert_array_equal(search.gaussian.spread, np.full(8, step))


@pytest.mark.parametrize("score", [0.0, 0.5])
def test_scores_that_are_all_the_same_do_no_harm(score: float) -> None:
    search = SMALL.begin(8, 0)
    while not search.done:
        genomes = search.ask()
        assert 0 <= genomes.min() <= genomes.max() <= 1
        search.tell(np.full(len(genomes), score))


@pytest.mark.parametrize("n", [1, 2, 3, 5])
@pytest.mark.parametrize("score", ["the same", "noise", "bowl"])
def test_few_genes_are_searched_to_the_end_whatever_the_scores_are(n: int, score: str) -> None:
    rng = np.random.default_rng(n)
    search = replace(SMALL, evaluations=2_000).begin(n, 0)
    while not search.done:
        genomes = search.ask()
        assert ((genomes >= 0) & (genomes <= 1)).all()
        bowl = 1 - ((genomes - 0.3) ** 2).sum(axis=1)
        search.tell({"the same": np.full(len(genomes), 0.5), "noise": rng.random(len(genomes)), "bowl": bowl}[score])
    if score == "bowl":
        np.testing.assert_allclose(search.best(1)[0][0], 0.3, atol=0.01)


def test_its_state_goes_on_the_same_out_of_a_file() -> None:
    """An array comes back in the order of its bytes in the file, upon which the last bit of a product depends."""
    one, other = cma_es(evaluations=2000).begin(20, 0), cma_es(evaluations=2000).begin(20, 0)
    while one.told < 1500:
        one.tell(1 - ((one.ask() - 0.3) ** 2).mean(axis=1))
    file = io.BytesIO()
    np.savez(file, allow_pickle=False, **one.state())
    file.seek(0)
    with np.load(file, allow_pickle=False) as arrays:
        other.restore({name: np.ascontiguousarray(arrays[name]).reshape(arrays[name].shape) for name in arrays.files})
    while not one.done:
        genomes = one.ask()
        assert genomes.tobytes() == other.ask().tobytes()
        for search in (one, other):
            search.tell(1 - ((genomes - 0.3) ** 2).mean(axis=1))


@pytest.mark.parametrize(
    "field",
    [
        "evaluations",
        "start_share",
        "start_most",
        "generations",
        "min_population",
        "max_population",
        "growth",
        "step",
        "known_step",
        "converged",
        "restart_step",
    ],
)
def test_settings_out_of_range_are_refused(field: str) -> None:
    with pytest.raises(ValueError, match=field):
        cma_es(**{field: -1})
