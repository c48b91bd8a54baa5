from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from treefit.search import TreeGA

SMALL = TreeGA(evaluations=4000, population=20, start_population=30, generations=20)


def test_levels_are_asked_as_one_batch_from_the_leaves_to_the_root() -> None:
    search = SMALL.begin(5, 0)
    nodes = []
    while not search.done:
        nodes.append(len(search.genomes))
        search.tell(np.random.default_rng(search.told).random(len(search.ask())))
    assert nodes[0] == 2 ** (search.depth - 1)
    assert nodes[-1] == 1
    assert all(later <= earlier for earlier, later in pairwise(nodes))


def test_elementary_gas_do_not_depend_on_each_other() -> None:
    """The scores of one node change nothing in what another of its level asks."""
    asked = []
    for favour in (0.0, 1.0):
        search = SMALL.begin(5, 0)
        for _ in range(5):
            genomes = search.ask()
            nodes = len(search.genomes)
            scores = genomes.sum(axis=1).reshape(nodes, -1)
            scores[0] *= favour
            search.tell(scores.ravel())
        asked.append(search.ask().reshape(nodes, -1, 5))
    assert (asked[0][0] != asked[1][0]).any()
    assert asked[0][1:].tobytes() == asked[1][1:].tobytes()


def test_the_root_starts_from_the_fittest_of_its_children() -> None:
    search = SMALL.begin(5, 0)
    while search.level > 0:
        before = search.scores
        search.tell(search.ask().sum(axis=1))
    assert search.scores.shape == (1, 10)
    assert search.scores[0, 0] >= before.max()


def test_the_root_starts_from_the_better_half_of_two_whole_populations() -> None:
    """What is dropped early, the worse half of each population, would not have been among them."""
    search = SMALL.begin(5, 0)
    while search.level > 0:
        before, asked = search.scores, search.ask().sum(axis=1).reshape(len(search.scores), -1)
        search.tell(asked.ravel())
    everyone = np.concatenate([before, asked], axis=1)
    assert search.scores[0].tolist() == sorted(everyone.ravel(), reverse=True)[:10]


@pytest.mark.parametrize("crossover", ["one_dot", "uniform"])
def test_no_child_equals_a_survivor_or_another_child_of_its_population(crossover: str) -> None:
    search = TreeGA(4000, 20, 30, 20, mutation_chance=0.1, crossover=crossover).begin(8, 0)
    while not search.done:
        nodes, survivors, children = len(search.genomes), search.genomes, search.ask()
        if len(children) % nodes == 0:
            for old, new in zip(survivors, children.reshape(nodes, -1, 8), strict=True):
                assert len(np.unique(np.concatenate([old, new]), axis=0)) == len(old) + len(new)
        search.tell(1 - ((children - 0.3) ** 2).mean(axis=1))


@pytest.mark.parametrize("field", ["evaluations", "population", "mutation_chance"])
def test_settings_out_of_range_are_refused(field: str) -> None:
    with pytest.raises(ValueError, match=field):
        TreeGA(**{field: -1})
