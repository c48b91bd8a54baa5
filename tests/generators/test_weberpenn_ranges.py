"""The search space of WeberPennGen: most random genomes are plausible trees; species are the same in it."""

from __future__ import annotations

import pytest

from generators.weberpenn import WeberPennGen
from tests.conftest import blob
from tests.generators.plausible import plausible_share
from treefit.fit import aim
from treefit.mask import Mask
from treefit.plant import Budget, Value, check_plant
from treefit.plant.characteristics import Characteristics
from treefit.plant.contract import same
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView

GENERATOR = WeberPennGen()
PUBLISHED = ("quaking_aspen", "black_tupelo", "weeping_willow", "black_oak")


def test_there_are_about_fifty_free_parameters() -> None:
    assert 40 <= len(GENERATOR.space) <= 60
    assert GENERATOR.size_parameter not in GENERATOR.space.names


def test_most_random_genomes_are_plausible_trees_with_a_score_on_every_example_picture(pictures: list[Mask]) -> None:
    assert plausible_share(GENERATOR, pictures, 60) >= 0.6


@pytest.mark.parametrize("values", [{"scale": 26.0}, {"scale_v": 5.0}], ids=str)
def test_height_shows_nothing_that_the_size_of_the_leaves_does_not(values: dict[str, Value]) -> None:
    """Lengths of leaves are in metres: a mask sees them by the height alone, so only one of the two is searched."""
    objective = aim(blob(), GENERATOR, PaperSimilarity(), Characteristics(), OrthographicView(), 3)
    space, view, frame = GENERATOR.space, objective.view, objective.frame
    budget = objective.budget
    small = space.complete({"leaf_scale": 0.3, "leaf_bend": 0.0})
    plant = GENERATOR(small, 3, budget)
    taller = GENERATOR({**small, **values}, 3, budget)
    growth = float(taller.position[:, 2].max() / plant.position[:, 2].max())
    assert abs(growth - 1) > 0.02
    same = GENERATOR({**small, **values, "leaf_scale": 0.3 * growth}, 3, budget)
    one, two = (view(each, frame).unpack() for each in (plant, same))
    assert (one > 0).any()
    assert (one != two).mean() < 1e-3


@pytest.mark.parametrize("name", PUBLISHED)
def test_published_species_are_the_same_bytes_each_time_and_in_either_space(name: str) -> None:
    preset, plants = GENERATOR.presets[name], []
    for generator in (GENERATOR, GENERATOR, WeberPennGen(full=True)):
        plants.append(generator(generator.space.complete(preset.values), preset.seed, Budget(300_000, 600_000)))
    assert not plants[0].cut
    assert same(plants[0], plants[1])
    assert same(plants[0], plants[2])


@pytest.mark.parametrize(
    ("name", "value"), [("levels", 7), ("curve_res_1", 0), ("shape", 9), ("whorl_2", 0), ("ratio", -1), ("scale", 0)]
)
def test_a_value_that_makes_no_plant_is_refused(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=f"parameter '{name}': must be at"):
        WeberPennGen().space.complete({name: value})


def test_a_trunk_grows_however_much_is_asked_for() -> None:
    generator = WeberPennGen()
    plant = generator(generator.space.complete({"branches_1": 1e7}), 0, Budget(1000, 1000))
    assert plant.cut
    check_plant(plant)
