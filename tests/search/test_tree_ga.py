from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from treefit.search import Hints, TreeGA
from treefit.search.operators import pick_parents

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


def paper(**settings: object) -> TreeGA:
    return replace(SMALL, **settings)


def test_a_child_that_is_not_mutated_is_the_head_of_one_survivor_and_the_tail_of_another() -> None:
    search = paper(mutation_chance=0.0).begin(8, 0)
    search.tell(search.ask().sum(axis=1))
    nodes, survivors, children = len(search.genomes), search.genomes, search.ask()
    for old, new in zip(survivors, children.reshape(nodes, -1, 8), strict=True):
        whole = 0
        for child in new:
            heads = (old == child).argmin(axis=1)  # genes up to the first that differs
            tails = (old == child)[:, ::-1].argmin(axis=1)
            whole += heads.max() + tails.max() >= 8
        assert whole >= len(new) - 1  # one may be a twin of a survivor, which is mutated always


def test_the_worse_half_of_a_population_is_removed() -> None:
    search = SMALL.begin(5, 0)
    search.tell(search.ask().sum(axis=1))
    before = search.scores.copy()
    children = search.ask().sum(axis=1).reshape(len(before), -1)
    assert before.shape[1] == children.shape[1] == SMALL.population // 2
    search.tell(children.ravel())
    for old, new, kept in zip(before, children, search.scores, strict=True):
        assert kept.tolist() == sorted([*old, *new], reverse=True)[:10]


def test_every_elementary_ga_has_the_same_generations_and_the_root_the_rest() -> None:
    search, asked = SMALL.begin(5, 0), []
    while not search.done:
        asked.append((search.depth - search.level, len(search.ask()) // len(search.genomes)))
        search.tell(np.random.default_rng(search.told).random(len(search.genomes) * asked[-1][1]))
    batches = [[size for level, size in asked if level == wanted] for wanted in range(1, search.depth + 1)]
    generations = search._generations()
    assert batches[0] == [30] + [10] * generations
    assert all(level == [10] * generations for level in batches[1:-1])
    assert generations <= len(batches[-1]) < generations + 2**search.depth


@pytest.mark.parametrize(("evaluations", "depth"), [(2500, 1), (10_000, 2), (30_000, 4), (50_000, 4), (60_000, 5)])
def test_the_depth_is_that_of_the_authors_program(evaluations: int, depth: int) -> None:
    assert TreeGA(evaluations=evaluations, start_population=125).begin(5, 0).depth == depth


def test_a_depth_of_one_is_a_plain_genetic_algorithm() -> None:
    search = paper(depth=1).begin(5, 0)
    assert [len(search.genomes), search.level, len(search.ask())] == [1, 0, 30]


def family(n: int = 8) -> Hints:
    draws = np.random.default_rng(4)
    return replace(Hints.none(n), rate=draws.random(n), quality=draws.normal(size=(n, 10)))


def test_the_best_by_quality_of_several_random_genomes_start() -> None:
    means = [
        family().mark(paper(start_tries=tries, start_population=200).begin(8, 0, family()).ask()).mean()
        for tries in (1, 3, 10)
    ]
    assert (np.diff(means) > 0.5).all()


def test_quality_leads_mutation_unless_it_is_not_guided() -> None:
    marks = []
    for guided, tries in ((False, 500), (True, 1), (True, 500)):
        search = paper(guided=guided, tries=tries, mutation_chance=1.0).begin(8, 0, family())
        search.tell(np.ones(len(search.ask())))
        marks.append(family().mark(search.ask()).mean())
    assert abs(marks[0] - marks[1]) < 0.5 < marks[2] - marks[1] - 0.5


def test_children_are_always_mutated_in_the_first_generations() -> None:
    """Of equal parents, so that every gene that differs was mutated."""
    search = paper(mutation_always=3, mutation_chance=0.0, depth=1).begin(8, 0)
    search.tell(np.ones(len(search.ask())))
    shares = []
    for _ in range(6):
        search.genomes[:] = 0.5 + 1e-9 * np.arange(10)[:, None]
        children = search.ask()
        shares.append((np.abs(children - 0.5) > 1e-6).any(axis=1).mean())
        search.tell(np.full(len(children), 0.1))
    assert shares[:3] == [1, 1, 1]
    assert max(shares[3:]) < 1


@pytest.mark.parametrize(("kind", "counts"), [("constant", {2}), ("uniform", {1, 2, 3})])
def test_the_count_of_changed_genes_is_constant_or_drawn(kind: str, counts: set[int]) -> None:
    search = paper(mutation_count=kind, mutation_genes=0.21 if kind == "constant" else 0.3).begin(8, 0)
    mutants = search._mutated(np.full((3000, 8), 0.5), 1.0, np.random.default_rng(0))
    found = (mutants != 0.5).sum(axis=1)
    assert set(found) == counts
    if kind == "uniform":  # floor(1 + 2.4 u): 1, 2 and the rest of 3
        np.testing.assert_allclose(np.bincount(found)[1:] / 3000, np.array([1, 1, 0.4]) / 2.4, atol=0.03)


def test_fitness_grows_steeper_with_the_generations_of_a_node(monkeypatch: pytest.MonkeyPatch) -> None:
    powers = []

    def noted(scores: np.ndarray, count: int, rng: np.random.Generator, power: float, least: float) -> np.ndarray:
        powers.append((search.level, power, least))
        return pick_parents(scores, count, rng, power, least)

    monkeypatch.setattr("treefit.search.tree_ga.pick_parents", noted)
    search = paper(fitness_growth=0.1, fitness_least=1e-4).begin(8, 0)
    while not search.done:
        search.tell(search.ask().mean(axis=1))
    for level in range(search.depth):
        of_level = sorted({power for at, power, _ in powers if at == level})
        np.testing.assert_allclose(of_level, 1 + 0.1 * np.arange(len(of_level)))
    assert {least for _, _, least in powers} == {1e-4}
