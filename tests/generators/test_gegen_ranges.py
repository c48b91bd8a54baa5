"""The search space of GEGen: most random genomes are plausible trees."""

from __future__ import annotations

import pytest

from generators.gegen import GEGen
from tests.generators.plausible import plausible, plausible_share
from treefit.mask import Mask
from treefit.plant import Budget, Plant, check_plant

GENERATOR = GEGen()
CROWN = 100
"""Vertices without which a tree is a rod."""


def branched(plant: Plant) -> bool:
    return plausible(plant) and plant.n_vertices >= CROWN and bool(plant.level.max() >= 2)


def test_there_are_about_thirty_five_free_parameters() -> None:
    assert 25 <= len(GENERATOR.space) <= 40
    assert not {GENERATOR.size_parameter, GENERATOR.age_parameter} & set(GENERATOR.space.names)


def test_most_random_genomes_are_plausible_trees_with_a_score_on_every_example_picture(pictures: list[Mask]) -> None:
    assert plausible_share(GENERATOR, pictures, 100, branched) >= 0.6


@pytest.mark.parametrize(
    ("name", "value"),
    [("age", 0), ("leader", 3), ("internode", 0), ("levels", 0), ("pipe", 0), ("bud_share", 1.1), ("light_right", 2)],
)
def test_a_value_that_makes_no_plant_is_refused(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=f"parameter '{name}': must be at"):
        GENERATOR.space.complete({name: value})


@pytest.mark.parametrize(
    "values",
    [
        {"age": 1}, {"internodes": 10}, {"internodes": 100_000}, {"levels": 1}, {"leader": 400}, {"trunk": 0.95},
        {"vigour": 0.0}, {"shade": 50.0}, {"shedding": 50.0}, {"whorl": 12, "forks": 12}, {"start": 100.0},
        {"start": 0.1, "age": 1}, {"lean": 80.0, "bend": -180.0}, {"wobble": 20.0}, {"tropism": -50.0},
        {"tip_radius": 1e-4, "pipe": 10.0},
    ],
    ids=str,
)  # fmt: skip
def test_values_far_from_the_ranges_make_plants_that_keep_to_the_contract(values: dict[str, float]) -> None:
    plant = GENERATOR(GENERATOR.space.complete(values), 1, Budget(5_000, 10_000))
    check_plant(plant)
    assert plant.position[:, 2].min() >= 0
