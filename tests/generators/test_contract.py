"""Contract that every generator passes."""

from __future__ import annotations

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from treefit.plant import Budget, Generator, Plant, check_plant

GENERATORS: dict[str, Generator] = {"simplegen": SimpleGen(), "simplegen_paper": SimpleGen(additions=False)}
FIELDS = ("position", "radius", "parent", "level", "leaf_position", "leaf_axis", "leaf_normal", "leaf_size")


@pytest.fixture(params=GENERATORS)
def generator(request: pytest.FixtureRequest) -> Generator:
    return GENERATORS[request.param]


def plants(generator: Generator, count: int, budget: Budget | None = None) -> list[Plant]:
    genomes = np.random.default_rng(3).random((count, len(generator.space)))
    return [generator(generator.space.decode(genome), 5, budget or Budget()) for genome in genomes]


def same(one: Plant, two: Plant) -> bool:
    return all(getattr(one, name).tobytes() == getattr(two, name).tobytes() for name in FIELDS)


def test_random_genomes_give_valid_plants(generator: Generator) -> None:
    for plant in plants(generator, 60):
        check_plant(plant)


def test_the_root_stands_at_the_origin_and_nothing_grows_below_the_ground(generator: Generator) -> None:
    for plant in plants(generator, 30):
        assert (plant.position[0] == 0).all()
        assert plant.position[:, 2].min() >= 0


def test_leaf_frames_are_unit_and_at_right_angles(generator: Generator) -> None:
    for plant in plants(generator, 30):
        np.testing.assert_allclose(np.linalg.norm(plant.leaf_axis, axis=1), 1, atol=1e-3)
        np.testing.assert_allclose(np.linalg.norm(plant.leaf_normal, axis=1), 1, atol=1e-3)
        np.testing.assert_allclose((plant.leaf_axis * plant.leaf_normal).sum(axis=1), 0, atol=2e-3)


def test_levels_rise_by_one_at_most_along_the_graph(generator: Generator) -> None:
    for plant in plants(generator, 30):
        rise = plant.level[1:] - plant.level[plant.parent[1:]]
        assert set(np.unique(rise)) <= {0, 1}


def test_the_same_input_gives_the_same_bytes(generator: Generator) -> None:
    assert all(same(one, two) for one, two in zip(plants(generator, 20), plants(generator, 20), strict=True))


def test_another_seed_gives_another_plant(generator: Generator) -> None:
    values = generator.space.complete({})
    assert not same(generator(values, 1, Budget()), generator(values, 2, Budget()))


@pytest.mark.parametrize("budget", [Budget(2, 0), Budget(50, 10), Budget(500, 100)])
def test_the_budget_is_never_passed_and_a_cut_is_told(generator: Generator, budget: Budget) -> None:
    for whole, plant in zip(plants(generator, 30), plants(generator, 30, budget), strict=True):
        assert plant.n_vertices <= budget.vertices
        assert plant.n_leaves <= budget.leaves
        fits = whole.n_vertices <= budget.vertices and whole.n_leaves <= budget.leaves
        assert plant.cut != fits
        if fits:
            assert same(plant, whole)


def test_the_size_parameter_scales_and_does_nothing_else(generator: Generator) -> None:
    values = generator.space.complete({})
    name = generator.size_parameter
    assert name is not None
    one, two = (generator({**values, name: size}, 1, Budget()) for size in (8.0, 16.0))
    np.testing.assert_allclose(2 * one.position, two.position, rtol=1e-4, atol=1e-4)
    np.testing.assert_allclose(2 * one.leaf_size, two.leaf_size, rtol=1e-4)
    np.testing.assert_allclose(2 * one.radius, two.radius, rtol=1e-4)
