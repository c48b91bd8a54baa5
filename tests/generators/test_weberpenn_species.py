"""Presets of WeberPennGen: each is a whole plant that has the habit of its species, whatever the seed."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from generators.weberpenn import WeberPennGen
from generators.weberpenn.parameters import FULL
from treefit.plant import Budget, Plant, check_plant
from treefit.plant.extent import extent_of
from treefit.plant.preset import Preset, read_presets
from treefit.view import Frame, OrthographicView

FOLDER = Path(__file__).parents[2] / "generators/weberpenn/species"
PRESETS = read_presets(FOLDER)
PUBLISHED = ("quaking_aspen", "black_tupelo", "weeping_willow", "black_oak")
OWN = sorted(set(PRESETS) - set(PUBLISHED))
WIDTH_AND_FOOT = re.compile(
    r"# Grown in the open: (\S+) to (\S+) of its height wide, the foot of the crown at (\S+) to (\S+)\."
)
CONIFERS = ("european_larch", "norway_spruce", "scots_pine", "silver_fir", "stone_pine")
VIEW, FRAME = OrthographicView(resolution=64), Frame(64, 4)


def grow(preset: Preset, seed: int) -> Plant:
    return WeberPennGen()(FULL.complete(preset.values), seed, Budget(300_000, 600_000))


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_is_a_plant_with_a_word_on_its_species(name: str) -> None:
    preset, first = PRESETS[name], (FOLDER / f"{name}.yaml").read_text(encoding="utf-8").splitlines()[0]
    assert first.startswith("# ")
    assert len(first.split(":")[1].split()) >= 8
    assert (preset.generator, preset.version) == (WeberPennGen.name, WeberPennGen.version)
    plant = grow(preset, preset.seed)
    check_plant(plant)
    assert not plant.cut


@pytest.mark.parametrize("name", OWN)
def test_species_of_our_own_fit_into_a_search(name: str) -> None:
    plant = grow(PRESETS[name], PRESETS[name].seed)
    assert plant.n_vertices <= 15_000
    assert plant.n_leaves <= 55_000


@pytest.mark.parametrize("name", OWN)
def test_every_seed_has_the_habit_of_its_species(name: str) -> None:
    told = WIDTH_AND_FOOT.match((FOLDER / f"{name}.yaml").read_text(encoding="utf-8").splitlines()[1])
    assert told is not None
    narrow, wide, low, high = (float(number) for number in told.groups())
    for seed in range(31, 34):
        plant = grow(PRESETS[name], seed)
        extent = extent_of(plant)
        crown = plant.leaf_position if plant.n_leaves else plant.position[plant.level >= 2]
        assert narrow <= extent.width / extent.height <= wide
        assert low <= np.quantile(crown[:, 2], 0.02) / extent.height <= high


@pytest.mark.parametrize("name", OWN)
def test_another_seed_is_another_tree(name: str) -> None:
    one, two = (VIEW(grow(PRESETS[name], seed), FRAME).unpack() != 0 for seed in (31, 32))
    assert np.sum(one != two) >= 0.12 * np.sum(one | two)


@pytest.mark.parametrize("name", CONIFERS)
def test_needles_stand_in_tufts(name: str) -> None:
    look = grow(PRESETS[name], 0).look
    assert look is not None
    assert look.leaf_shape == "tuft"


def test_species_have_leaves_of_their_own_outline() -> None:
    wished = {"black_oak": "oak", "sugar_maple": "lobed", "thuja": "scale", "italian_cypress": "scale",
              "umbrella_thorn": "compound", "weeping_willow": "narrow"}  # fmt: skip
    assert {name: PRESETS[name].values["leaf_shape"] for name in wished} == wished
