"""The files of conf/optimizer against what they say they are."""

from __future__ import annotations

from dataclasses import asdict

import pytest

from tests.search.settings import kind, settings
from treefit.search import CMAES, TreeGA


@pytest.mark.parametrize("name", ["tree_ga", "lshade", "cma", "de", "random", "treefit"])
def test_a_file_says_what_its_class_has_by_default(name: str) -> None:
    assert settings(name) == asdict(kind(name)())


def test_tree_ga_is_the_papers_text() -> None:
    """Its section 5: a random start, plain fitness, one dot, constant shares, guided by V and Q, 500 tries."""
    paper = TreeGA()
    assert (paper.start, paper.start_tries, paper.crossover) == ("random", 1, "one_dot")
    assert (paper.fitness_growth, paper.fitness_least, paper.rate_floor, paper.mutation_always) == (0, 0, 0, 0)
    assert (paper.guided, paper.tries, paper.mutation_count) == (True, 500, "constant")


@pytest.mark.parametrize(("name", "base"), [("tree_ga_authors", TreeGA), ("ga", TreeGA), ("cma_es", CMAES)])
def test_the_other_files_name_all_settings_of_their_class(name: str, base: type) -> None:
    assert kind(name) is base
    assert settings(name).keys() == asdict(base()).keys()
    base(**settings(name))


def test_the_authors_settings_are_those_that_they_stored() -> None:
    given = settings("tree_ga_authors")
    assert given == {
        "evaluations": 50000, "population": 100, "start_population": 125,
        "generations": 75, "depth": 0, "start": "random", "start_tries": 10, "fitness_growth": 0.1,
        "fitness_least": 1e-4, "crossover": "uniform", "mutation_chance": 0.5, "mutation_always": 30,
        "mutation_genes": 0.15, "mutation_count": "uniform", "guided": False, "rate_floor": 0.05, "tries": 1,
    }  # fmt: skip
