"""Presets of WeberPennGen: each is a whole plant that has the habit of its species, whatever the seed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generators.weberpenn import WeberPennGen
from generators.weberpenn.parameters import FULL
from treefit.plant import Budget, Plant, check_plant
from treefit.plant.extent import extent_of
from treefit.plant.preset import Preset, read_presets

FOLDER = Path(__file__).parents[2] / "generators/weberpenn/species"
PRESETS = read_presets(FOLDER)
PUBLISHED = ("quaking_aspen", "black_tupelo", "weeping_willow", "black_oak")
OWN = sorted(set(PRESETS) - set(PUBLISHED))
WIDTH_AND_BARE = {  # width of the crown and height of its foot by that of the tree, of grown trees that stand free
    "norway_spruce": (0.25, 0.45, 0.00, 0.10), "silver_fir": (0.25, 0.45, 0.08, 0.25),
    "european_larch": (0.30, 0.50, 0.05, 0.20), "thuja": (0.30, 0.50, 0.00, 0.10),
    "italian_cypress": (0.10, 0.22, 0.00, 0.12), "lombardy_poplar": (0.15, 0.28, 0.05, 0.22),
    "scots_pine": (0.45, 0.90, 0.40, 0.65), "stone_pine": (0.85, 1.30, 0.55, 0.80),
    "silver_birch": (0.40, 0.70, 0.15, 0.35), "small_leaved_linden": (0.55, 0.85, 0.08, 0.25),
    "sugar_maple": (0.55, 0.85, 0.15, 0.35), "apple": (0.90, 1.40, 0.20, 0.45),
    "umbrella_thorn": (1.30, 2.00, 0.40, 0.70), "weeping_cherry": (0.90, 1.40, 0.05, 0.30),
    "coconut_palm": (0.55, 1.00, 0.30, 0.60), "hazel": (0.70, 1.40, 0.20, 0.50), "snow_gum": (0.70, 1.30, 0.30, 0.60),
    "winter_oak": (0.85, 1.30, 0.10, 0.35),
}  # fmt: skip


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
    narrow, wide, low, high = WIDTH_AND_BARE[name]
    for seed in range(31, 34):
        plant = grow(PRESETS[name], seed)
        extent = extent_of(plant)
        crown = plant.leaf_position if plant.n_leaves else plant.position[plant.level >= 2]
        assert narrow <= extent.width / extent.height <= wide
        assert low <= np.quantile(crown[:, 2], 0.02) / extent.height <= high
