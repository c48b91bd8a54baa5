"""Searches that are replayed, above all those of other packages."""

from __future__ import annotations

import gc
import subprocess
import sys
import threading

import numpy as np
import pytest

from treefit.search import LSHADE, DifferentialEvolution, PyCMA, Strategy
from treefit.search.differential_evolution import turned_round
from treefit.search.optimizer import Genomes, Scores
from treefit.search.replay import Moves, Replay

OTHERS: dict[str, Strategy] = {
    "cma": PyCMA(evaluations=3000, population=16),
    "de": DifferentialEvolution(evaluations=6000, population=30),
    "lshade": LSHADE(evaluations=3000, population=40),
}


def hill(genomes: Genomes) -> Scores:
    return 1 - ((genomes - np.linspace(0, 1, genomes.shape[1])) ** 2).mean(axis=1)


@pytest.mark.parametrize("name", OTHERS)
def test_a_hill_with_its_top_in_the_border_is_climbed(name: str) -> None:
    search = OTHERS[name].begin(8, 0)
    while not search.done:
        search.tell(hill(search.ask()))
    assert search.best(1)[1][0] > 1 - 1e-4


@pytest.mark.parametrize("name", OTHERS)
def test_the_global_draws_of_numpy_are_neither_used_nor_changed(name: str) -> None:
    asked = []
    for seed in (1, 2):
        np.random.set_state(np.random.RandomState(seed).get_state())  # noqa: NPY002
        before = np.random.get_state()[1].tobytes()  # noqa: NPY002
        search, genomes = OTHERS[name].begin(6, 0), []
        for _ in range(30):
            genomes.append(search.ask())
            search.tell(hill(genomes[-1]))
        assert np.random.get_state()[1].tobytes() == before  # noqa: NPY002
        asked.append(np.concatenate(genomes).tobytes())
    assert asked[0] == asked[1]


@pytest.mark.parametrize("name", OTHERS)
@pytest.mark.parametrize("score", [0.0, 0.5])
def test_scores_that_are_all_the_same_do_no_harm(name: str, score: float, capfd: pytest.CaptureFixture[str]) -> None:
    search = OTHERS[name].begin(6, 0)
    while not search.done:
        genomes = search.ask()
        assert 0 <= genomes.min() <= genomes.max() <= 1
        search.tell(np.full(len(genomes), score))
    assert capfd.readouterr().out == ""


@pytest.mark.parametrize("genes", [1, 2, 100])
@pytest.mark.parametrize("name", OTHERS)
def test_any_count_of_genes_is_searched(name: str, genes: int) -> None:
    search = OTHERS[name].begin(genes, 0)
    for _ in range(10):
        genomes = search.ask()
        assert genomes.shape[1] == genes
        search.tell(hill(genomes))


def test_cma_starts_again_once_it_has_converged() -> None:
    search, spreads = PyCMA(evaluations=4000, population=16, converged=0.01).begin(5, 0), []
    while not search.done:
        genomes = search.ask()
        spreads.append(float(genomes.std(axis=0).max()))
        search.tell(hill(genomes))
    widened = np.flatnonzero((np.array(spreads[1:]) > 0.1) & (np.array(spreads[:-1]) < 0.02))
    assert len(widened) >= 1


def threads() -> int:
    return sum(thread.name == "differential evolution" for thread in threading.enumerate())


def test_a_dropped_search_ends_its_thread() -> None:
    searches = [OTHERS["de"].begin(5, seed) for seed in range(3)]
    for search in searches:
        search.tell(hill(search.ask()))
        search.ask()
    assert threads() == 3
    searches[0].restore({"scores": np.empty(0)})
    assert threads() == 2
    del searches, search
    gc.collect()
    assert threads() == 0


def test_a_program_ends_with_a_search_under_way() -> None:
    code = (
        "from treefit.search import DifferentialEvolution as D\n"
        "search = D(evaluations=500).begin(4, 0)\nsearch.ask()\nprint('end')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=True)
    assert (done.stdout, done.stderr) == ("end\n", "")


def test_an_error_on_the_thread_is_raised_where_the_search_is_driven() -> None:
    def failing(score: object) -> None:
        raise ZeroDivisionError("of scipy")

    with pytest.raises(ZeroDivisionError, match="of scipy"):
        next(turned_round(failing))


def test_the_state_are_the_scores_alone() -> None:
    def moves() -> Moves:
        while True:
            yield np.full((3, 2), 0.5)

    search = Replay("", moves, 2, 8)
    for scores in ([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]):
        search.ask()
        search.tell(np.array(scores))
    assert {name: array.tolist() for name, array in search.state().items()} == {"scores": [1, 2, 3, 4, 5, 6]}
    assert len(search.ask()) == 2


@pytest.mark.parametrize("strategy", ["best", "rand3bin", "best21bin", "randtobest2bin"])
def test_a_strategy_that_scipy_does_not_know_is_refused(strategy: str) -> None:
    with pytest.raises(ValueError, match="strategy"):
        DifferentialEvolution(strategy=strategy)


@pytest.mark.parametrize("kind", [PyCMA, DifferentialEvolution])
def test_settings_out_of_range_are_refused(kind: type[PyCMA] | type[DifferentialEvolution]) -> None:
    for field in ("evaluations", "population"):
        with pytest.raises(ValueError, match=field):
            kind(**{field: -1})
