"""The search space of GEGen: most random genomes are plausible trees."""

from __future__ import annotations

import numpy as np
import pytest

from generators.gegen import GEGen
from tests.generators.test_weberpenn_ranges import plausible
from treefit.fit import aim
from treefit.mask import Mask
from treefit.objective import Objective
from treefit.plant import Budget, check_plant
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Mix
from treefit.view import OrthographicView

GENERATOR = GEGen()
CROWN = 100
"""Vertices without which a tree is a rod."""


@pytest.fixture
def objectives(pictures: list[Mask]) -> list[Objective]:
    wishes = Characteristics(vertices=3000)
    return [aim(mask, GENERATOR, Mix(), wishes, OrthographicView(), 0) for mask in pictures]


def test_there_are_about_thirty_five_free_parameters() -> None:
    assert 25 <= len(GENERATOR.space) <= 40
    assert not {GENERATOR.size_parameter, GENERATOR.age_parameter} & set(GENERATOR.space.names)


def test_most_random_genomes_are_plausible_trees_with_a_score_on_every_example_picture(
    objectives: list[Objective],
) -> None:
    genomes = np.random.default_rng(0).random((100, len(GENERATOR.space)))
    good = 0
    for genome in genomes:
        plant = GENERATOR(GENERATOR.space.decode(genome), 0, objectives[0].budget)
        branched = plant.n_vertices >= CROWN and plant.level.max() >= 2
        good += plausible(plant) and branched and all(objective(genome).total > 0 for objective in objectives)
    assert good / len(genomes) >= 0.6


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
