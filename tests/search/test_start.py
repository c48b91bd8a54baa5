from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.search.settings import cma_es
from tests.search.test_contract import KNOWN, hints, run
from treefit.search import LSHADE, DifferentialEvolution, Hints, PyCMA, RandomSearch, TreeGA
from treefit.search.start import STEPS, Start, children, first_genomes

STRATEGIES = {
    "tree_ga": TreeGA(evaluations=1500, population=20, start_population=30, generations=10),
    "cma_es": cma_es(evaluations=1500, start_share=0.3, generations=80, min_population=8),
    "random": RandomSearch(evaluations=1500, batch=120),
    "lshade": LSHADE(evaluations=1500, population=120),
    "de": DifferentialEvolution(evaluations=1500, population=120),
}
ASKS_OF_THE_START = {"tree_ga": 1, "cma_es": 5, "random": 1, "lshade": 1, "de": 1}


def begin(name: str, start: Start, known: np.ndarray | None = KNOWN, seed: int = 1) -> np.ndarray:
    """Everything that a search asks in its start."""
    search = replace(STRATEGIES[name], start=start).begin(8, seed, hints(known))
    return np.concatenate(run(search, ASKS_OF_THE_START[name]))


def near(genomes: np.ndarray, known: np.ndarray = KNOWN) -> np.ndarray:
    """Whether every gene of a genome (m, n) is near to that of one of the known ones, as with children of theirs."""
    return (np.abs(genomes[:, None] - known).min(axis=1) < 5 * max(STEPS)).all(axis=1)


@pytest.mark.parametrize("name", STRATEGIES)
@pytest.mark.parametrize("start", ["presets", "mixed"])
def test_every_known_genome_is_asked_once(name: str, start: Start) -> None:
    asked = begin(name, start)
    assert [int((asked == genome).all(axis=1).sum()) for genome in KNOWN] == [1] * len(KNOWN)
    assert 0 <= asked.min() <= asked.max() <= 1
    assert len(np.unique(asked, axis=0)) == len(asked)


@pytest.mark.parametrize("name", STRATEGIES)
@pytest.mark.parametrize(("start", "count"), [("guess", 5), ("mixed", 0), ("random", 0)])
def test_what_the_target_suggests_is_asked_after_the_known_genomes_when_wished(
    name: str, start: Start, count: int
) -> None:
    guess = np.random.default_rng(9).random((5, 8))
    suggested = replace(Hints.none(8), known=KNOWN, guess=guess)
    search = replace(STRATEGIES[name], start=start).begin(8, 1, suggested)
    asked = np.concatenate(run(search, ASKS_OF_THE_START[name]))
    assert (asked[:, None] == guess).all(axis=2).sum() == count
    if name in ("cma_es", "random", "lshade", "de") and start == "guess":
        np.testing.assert_array_equal(asked[:12], [*KNOWN, *guess])


def test_each_start_of_cma_is_from_the_next_of_the_leading_genomes() -> None:
    guess = np.full((1, 8), 0.95)
    search = PyCMA(400, 16, step=1e-3, converged=1.0, start="guess").begin(8, 1, replace(Hints.none(8), guess=guess))
    np.testing.assert_allclose(search.ask(), 0.95, atol=0.01)


@pytest.mark.parametrize("name", STRATEGIES)
@pytest.mark.parametrize(("start", "share"), [("random", 1.0), ("mixed", 0.5), ("presets", 0.0)])
def test_of_the_genomes_that_are_not_known_the_promised_share_is_uniform(name: str, start: Start, share: float) -> None:
    """Uniform ones are those of a random start with the same seed, in the same places."""
    asked = begin(name, start)
    known = 0 if start == "random" else len(KNOWN)
    uniform = (asked == begin(name, "random")).all(axis=1).sum()
    assert uniform == pytest.approx(share * (len(asked) - known), abs=4)  # half of one for each batch or node


@pytest.mark.parametrize("name", STRATEGIES)
@pytest.mark.parametrize("known", [None, KNOWN[:0]])
def test_without_known_genomes_every_start_is_a_random_one(name: str, known: np.ndarray | None) -> None:
    starts: tuple[Start, ...] = ("random", "presets", "mixed")
    assert len({begin(name, start, known).tobytes() for start in starts} | {begin(name, "random").tobytes()}) == 1


@pytest.mark.parametrize("name", STRATEGIES)
def test_the_same_seed_begins_with_the_same_genomes_and_another_does_not(name: str) -> None:
    one, two, other = (begin(name, "presets", seed=seed).tobytes() for seed in (1, 1, 2))
    assert one == two != other


def test_the_leaves_of_the_tree_share_the_known_genomes_out() -> None:
    search = STRATEGIES["tree_ga"].begin(8, 1, hints(KNOWN))
    nodes = search.ask().reshape(-1, 30, 8)
    counts = [sum(int((node == genome).all(axis=1).any()) for genome in KNOWN) for node in nodes]
    assert len(nodes) > 1
    assert max(counts) - min(counts) <= 1


def test_random_search_is_uniform_after_its_first_batch() -> None:
    asked = run(replace(STRATEGIES["random"], start="presets").begin(8, 1, hints(KNOWN)))
    uniform = run(replace(STRATEGIES["random"], start="random").begin(8, 1, hints(KNOWN)))
    assert np.concatenate(asked[1:]).tobytes() == np.concatenate(uniform[1:]).tobytes()


def test_more_known_genomes_than_places_are_cut() -> None:
    many = np.random.default_rng(0).random((50, 8))
    genomes = first_genomes("mixed", many, np.arange(20), np.random.default_rng(0))
    np.testing.assert_array_equal(genomes, many[:20])


@pytest.mark.parametrize("count", [1, 2, 7])
def test_children_are_near_to_known_genomes_by_several_steps(count: int) -> None:
    born = children(KNOWN[:count], 3000, np.random.default_rng(0))
    apart = np.sqrt(((born[:, None] - KNOWN[:count]) ** 2).mean(axis=2)).min(axis=1)
    assert near(born, KNOWN[:count]).all()
    assert not (born[:, None] == KNOWN[:count]).all(axis=2).any()
    for step in STEPS if count == 1 else ():
        assert (np.abs(apart - step) < 0.4 * step).mean() == pytest.approx(1 / 3, abs=0.1)


def test_half_of_the_children_are_crossed_from_two() -> None:
    """One known genome is all 0.2, the other all 0.8: a crossed one is near to both, with its first genes to one."""
    known = np.repeat([[0.2], [0.8]], 40, axis=1)
    high = children(known, 4000, np.random.default_rng(0)) > 0.5
    assert (high[:, 0] != high[:, -1]).mean() == pytest.approx(0.25, abs=0.03)  # two different parents: half of half


@pytest.mark.parametrize(("known", "reason"), [
    (np.zeros((3, 7)), r"shape \(m, 8\), got \(3, 7\)"), (np.zeros(8), "shape"),
    (np.full((2, 8), 1.01), r"in \[0, 1\]"), (np.full((2, 8), np.nan), r"in \[0, 1\]"),
])  # fmt: skip
def test_known_genomes_that_are_none_are_refused(known: np.ndarray, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        replace(Hints.none(8), known=known)


@pytest.mark.parametrize("name", STRATEGIES)
def test_another_word_for_the_start_is_refused(name: str) -> None:
    with pytest.raises(ValueError, match="'random', 'presets', 'mixed' or 'guess'"):
        type(STRATEGIES[name])(start="species")  # type: ignore[arg-type]
