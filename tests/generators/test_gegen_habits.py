"""Presets of GEGen: each is a whole tree that has its habit, whatever the seed."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from generators.gegen import GEGen
from treefit.plant import Budget, Plant, check_plant
from treefit.plant.characteristics import leaf_density
from treefit.plant.extent import extent_of

FOLDER = Path(__file__).parents[2] / "generators/gegen/habits"
GENERATOR = GEGen()
PRESETS = GENERATOR.presets
SEEDS = (31, 32, 33)
seeds = pytest.mark.parametrize("seed", SEEDS)


@cache
def grow(name: str, seed: int) -> Plant:
    return GENERATOR(PRESETS[name].values, seed, Budget(60_000, 120_000))


def height(plant: Plant) -> float:
    return extent_of(plant).height


def slimness(plant: Plant) -> float:
    """Height by width."""
    return height(plant) / extent_of(plant).width


def crown(plant: Plant) -> NDArray[np.float32]:
    return plant.leaf_position if plant.n_leaves else plant.position[plant.level >= 2]


def foot(plant: Plant) -> float:
    """Height by that of the tree under which hardly a leaf is."""
    return float(np.quantile(crown(plant)[:, 2], 0.02)) / height(plant)


def widest(plant: Plant) -> float:
    """Height by that of the tree at which leaves reach furthest from the trunk."""
    points = crown(plant)
    far = np.argsort(np.hypot(points[:, 0], points[:, 1]))[-len(points) // 100 :]
    return float(points[far, 2].mean()) / height(plant)


def stoutness(plant: Plant) -> float:
    """Radius of the trunk by the height of the tree."""
    return float(plant.radius[0]) / height(plant)


def stems_at(plant: Plant, share: float) -> int:
    """Count of stems at a share of the height that have a fifth of the radius of the trunk at least."""
    level, z = share * height(plant), plant.position[:, 2]
    across = (z[1:] >= level) & (z[plant.parent[1:]] < level) & (plant.radius[1:] > plant.radius[0] / 5)
    return int(np.sum(across))


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_is_a_whole_tree_with_a_word_on_its_habit(name: str) -> None:
    first = (FOLDER / f"{name}.yaml").read_text(encoding="utf-8").splitlines()[0]
    assert first.startswith("# ")
    assert len(first.split(":")[1].split()) >= 6
    preset = PRESETS[name]
    assert (preset.generator, preset.version) == (GEGen.name, GEGen.version)
    plant = GENERATOR(preset.values, preset.seed, Budget(60_000, 120_000))
    check_plant(plant)
    assert not plant.cut
    assert plant.n_vertices <= 8_000
    assert plant.n_leaves <= 30_000


@seeds
def test_a_spruce_is_a_cone_around_a_straight_leader(seed: int) -> None:
    plant = grow("spruce", seed)
    trunk = plant.position[plant.level == 0]
    assert slimness(plant) > 1.6
    assert widest(plant) < 1 / 3
    assert trunk[:, 2].max() > 0.95 * plant.position[:, 2].max()
    assert np.hypot(trunk[:, 0], trunk[:, 1]).max() < 0.04 * height(plant)


@seeds
def test_a_thuja_is_a_narrow_cone_from_the_ground(seed: int) -> None:
    plant = grow("thuja", seed)
    assert slimness(plant) > 1.7
    assert widest(plant) < 0.5
    assert foot(plant) < 0.2


@seeds
def test_a_poplar_is_a_column(seed: int) -> None:
    plant = grow("poplar", seed)
    assert slimness(plant) > 3
    assert foot(plant) < 0.25


@seeds
def test_twigs_of_the_weeping_tree_hang(seed: int) -> None:
    plant = grow("weeping", seed)
    ends = np.setdiff1d(np.arange(1, plant.n_vertices), plant.parent)
    down = plant.position[ends, 2] < plant.position[plant.parent[ends], 2]
    assert down.mean() > 0.7
    assert np.mean(plant.leaf_axis[:, 2] < 0) > 0.7
    assert foot(plant) < 0.3


@seeds
def test_a_shrub_has_many_stems_from_the_ground(seed: int) -> None:
    assert stems_at(grow("shrub", seed), 0.12) >= 6
    assert height(grow("shrub", seed)) < 4
    assert stems_at(grow("solitary", seed), 0.12) == 1


@seeds
def test_an_umbrella_pine_has_a_flat_crown_on_a_bare_trunk(seed: int) -> None:
    plant = grow("umbrella_pine", seed)
    deep = float(np.ptp(np.quantile(plant.leaf_position[:, 2], (0.02, 0.98))))
    assert extent_of(plant).width > 1.5 * deep
    assert foot(plant) > 0.5


@seeds
def test_an_oak_is_as_wide_as_high_on_a_thick_trunk(seed: int) -> None:
    plant = grow("oak", seed)
    assert slimness(plant) < 1.15
    assert stoutness(plant) > 0.025
    assert foot(plant) < 0.45


@seeds
def test_a_fruit_tree_is_low_and_round(seed: int) -> None:
    plant = grow("apple", seed)
    assert height(plant) < 6
    assert slimness(plant) < 1.15


@seeds
def test_a_birch_is_slim_and_airy(seed: int) -> None:
    plant, broad = grow("birch", seed), grow("solitary", seed)
    assert slimness(plant) > 1.3
    assert stoutness(plant) < 0.6 * stoutness(broad)
    assert leaf_density(plant) * height(plant) < 0.9 * leaf_density(broad) * height(broad)


@seeds
def test_a_winter_tree_is_twigs(seed: int) -> None:
    plant = grow("winter", seed)
    assert plant.n_leaves == 0
    assert np.median(plant.radius) < 0.05 * plant.radius[0]


@seeds
def test_the_windswept_crown_is_to_one_side(seed: int) -> None:
    plant = grow("windswept", seed)
    assert plant.leaf_position[:, 0].mean() > 0.2 * height(plant)


@seeds
def test_a_young_tree_is_slim_with_few_branches(seed: int) -> None:
    plant = grow("young", seed)
    assert plant.n_vertices < 800
    assert slimness(plant) > 1.4
    assert stoutness(plant) < 0.012


@seeds
def test_a_tree_of_the_forest_is_slimmer_and_barer_than_the_same_tree_alone(seed: int) -> None:
    forest, alone = PRESETS["forest_grown"].values, PRESETS["solitary"].values
    assert {name for name in alone if forest[name] != alone[name]} == {"neighbour_left", "neighbour_right", "gap"}
    one, other = grow("forest_grown", seed), grow("solitary", seed)
    assert slimness(one) > 1.5 * slimness(other)
    assert height(one) > height(other)
    assert foot(one) > foot(other)


def test_habits_have_leaves_of_their_own_outline() -> None:
    wished = {"oak": "oak", "birch": "broad", "spruce": "tuft", "umbrella_pine": "tuft", "thuja": "scale",
              "weeping": "narrow"}  # fmt: skip
    for name, shape in wished.items():
        look = GENERATOR(PRESETS[name].values, 0, Budget(200, 400)).look
        assert look is not None
        assert look.leaf_shape == shape
    assert GENERATOR(PRESETS["solitary"].values, 0, Budget(200, 400)).look is None


def test_the_outline_of_leaves_is_no_gene_and_changes_no_plant() -> None:
    values = PRESETS["oak"].values
    one, other = (GENERATOR({**values, "leaf_shape": shape}, 0, Budget(200, 400)) for shape in ("oak", "auto"))
    assert "leaf_shape" not in GENERATOR.space.names
    assert one.position.tobytes() == other.position.tobytes()
    assert one.leaf_size.tobytes() == other.leaf_size.tobytes()
