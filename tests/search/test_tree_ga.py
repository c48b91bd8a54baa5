from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from treefit.search import TreeGA

SMALL = TreeGA(evaluations=4000, population=20, start_population=30, generations=20)


def test_levels_are_asked_as_one_batch_from_the_leaves_to_the_root() -> None:
    search = SMALL.start(5, 0)
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
        search = SMALL.start(5, 0)
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
    search = SMALL.start(5, 0)
    while search.level > 0:
        before = search.scores
        search.tell(search.ask().sum(axis=1))
    assert search.scores.shape == (1, 20)
    assert search.scores[0, 0] >= before.max()


@pytest.mark.parametrize("field", ["evaluations", "population", "mutation_chance"])
def test_settings_out_of_range_are_refused(field: str) -> None:
    with pytest.raises(ValueError, match=field):
        TreeGA(**{field: -1})
