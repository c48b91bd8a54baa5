"""Contract that every generator passes."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from generators.gegen import GEGen
from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from treefit.plant import Budget, Generator, Plant, check_plant

GENERATORS: dict[str, Generator] = {
    "simplegen": SimpleGen(), "simplegen_paper": SimpleGen(additions=False),
    "weberpenn": WeberPennGen(), "weberpenn_full": WeberPennGen(full=True),
    "gegen": GEGen(),
}  # fmt: skip
FIELDS = ("position", "radius", "parent", "level", "leaf_position", "leaf_axis", "leaf_normal", "leaf_size")
SMALL = Budget(4_000, 8_000)


@pytest.fixture(params=GENERATORS)
def generator(request: pytest.FixtureRequest) -> Generator:
    return GENERATORS[request.param]


def plants(generator: Generator, count: int, budget: Budget = SMALL) -> list[Plant]:
    genomes = np.random.default_rng(3).random((count, len(generator.space)))
    return [generator(generator.space.decode(genome), 5, budget) for genome in genomes]


def same(one: Plant, two: Plant) -> bool:
    return all(getattr(one, name).tobytes() == getattr(two, name).tobytes() for name in FIELDS)


def test_random_genomes_give_valid_plants(generator: Generator) -> None:
    for plant in plants(generator, 300):
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


def test_the_same_input_gives_the_same_bytes_in_any_thread_and_whatever_grew_before(generator: Generator) -> None:
    for budget in (SMALL, Budget(400, 800)):
        with ThreadPoolExecutor(1) as fresh:
            alone = fresh.submit(plants, generator, 30, budget).result()
        plants(generator, 2, Budget())
        assert all(same(one, two) for one, two in zip(alone, plants(generator, 30, budget), strict=True))


def test_another_seed_gives_another_plant(generator: Generator) -> None:
    values = generator.space.complete({})
    assert not same(generator(values, 1, SMALL), generator(values, 2, SMALL))


@pytest.mark.parametrize("budget", [Budget(2, 0), Budget(50, 10), Budget(500, 100)])
def test_the_budget_is_never_passed_and_a_cut_is_told(generator: Generator, budget: Budget) -> None:
    for whole, plant in zip(plants(generator, 30), plants(generator, 30, budget), strict=True):
        assert plant.n_vertices <= budget.vertices
        assert plant.n_leaves <= budget.leaves
        fits = not whole.cut and whole.n_vertices <= budget.vertices and whole.n_leaves <= budget.leaves
        assert plant.cut != fits
        if fits:
            assert same(plant, whole)


def test_a_plant_is_cut_when_a_vertex_or_a_leaf_has_no_room_and_not_before(generator: Generator) -> None:
    genomes = np.random.default_rng(8).random((80, len(generator.space)))
    grown = 0
    for genome in genomes:
        values = generator.space.decode(genome)
        whole = generator(values, 5, SMALL)
        vertices, leaves = whole.n_vertices, whole.n_leaves
        if whole.cut or vertices < 3:
            continue
        assert same(generator(values, 5, Budget(vertices, leaves)), whole)
        assert not generator(values, 5, Budget(vertices, leaves)).cut
        assert generator(values, 5, Budget(vertices - 1, leaves)).cut
        assert leaves == 0 or generator(values, 5, Budget(vertices, leaves - 1)).cut
        grown += 1
    assert grown >= 3


def test_the_size_parameter_scales_and_does_nothing_else(generator: Generator) -> None:
    """Lengths of leaves double too, or have a parameter of their own."""
    values = generator.space.complete({})
    name = generator.size_parameter
    assert name is not None
    one, two = (generator({**values, name: size}, 1, Budget()) for size in (8.0, 16.0))
    assert not one.cut
    np.testing.assert_allclose(2 * one.position, two.position, rtol=1e-4, atol=1e-4)
    np.testing.assert_allclose(2 * one.radius, two.radius, rtol=1e-4)
    np.testing.assert_allclose(2 * one.leaf_position, two.leaf_position, rtol=1e-4, atol=1e-4)
    np.testing.assert_allclose(one.leaf_axis, two.leaf_axis, atol=2e-3)
    growth = two.leaf_size / one.leaf_size
    assert growth == pytest.approx(1, rel=1e-4) or growth == pytest.approx(2, rel=1e-4)


def test_presets_are_plants_of_the_generator_and_of_its_space(generator: Generator) -> None:
    for name, preset in generator.presets.items():
        assert (preset.generator, preset.version) == (generator.name, generator.version), name
        assert set(preset.values) <= {parameter.name for parameter in generator.space.parameters}, name
        check_plant(generator(generator.space.complete(preset.values), preset.seed, SMALL))
        genome = generator.space.encode(preset.values)
        assert ((genome >= 0) & (genome <= 1)).all(), name
        values = generator.space.decode(genome)
        assert generator.space.decode(generator.space.encode(values)) == pytest.approx(values), name
