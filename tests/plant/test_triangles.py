"""The count of triangles is that of the file, though no mesh is made."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generators.gegen import GEGen
from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from treefit.asset import AssetSettings, write_glb
from treefit.asset.mesh.leaf_outline import leaf_card
from treefit.asset.model import model_of
from treefit.plant import LEAF_SHAPES, Budget, Generator, Look, Plant
from treefit.plant.characteristics import Characteristics
from treefit.plant.triangles import OF_A_LEAF, OUTLINE, SIDES, budget_of, triangles

GENERATORS = [SimpleGen(), WeberPennGen(), GEGen()]


def grown(generator: Generator, count: int) -> list[Plant]:
    rng = np.random.default_rng(4)
    genomes = rng.random((count, len(generator.space)))
    return [generator(generator.space.decode(genome), 1, Budget(3000, 6000)) for genome in genomes]


def written(plant: Plant, settings: AssetSettings) -> int:
    return model_of(plant, settings).counts.triangles


@pytest.mark.parametrize("generator", GENERATORS, ids=lambda generator: generator.name)
def test_the_count_is_that_of_the_file(generator: Generator, tmp_path: Path) -> None:
    plants = grown(generator, 6)
    assert triangles(plants[0]) == write_glb(plants[0], tmp_path / "tree.glb", AssetSettings()).triangles
    for plant in plants[1:]:
        assert triangles(plant) == written(plant, AssetSettings())


@pytest.mark.parametrize(("sides", "outline"), [(3, "needle"), (4, "auto"), (5, "tuft"), (12, "frond"), (32, "round")])
def test_the_count_follows_the_settings_of_the_mesh(sides: int, outline: str) -> None:
    settings = AssetSettings(sides=sides, leaf_outline=outline)
    for plant in [*grown(GENERATORS[0], 2), *(replace(plant, look=Look(7, 0.2)) for plant in grown(GENERATORS[1], 2))]:
        assert triangles(plant, sides, outline) == written(plant, settings)
        wish = Characteristics(None, triangles=written(plant, settings), sides=sides, leaf_outline=outline)
        assert wish.multipliers(plant) == {"triangles": 1}


def test_defaults_are_those_of_the_files() -> None:
    assert (AssetSettings().sides, AssetSettings().leaf_outline) == (SIDES, OUTLINE)
    assert {shape: len(leaf_card(shape).faces) for shape in LEAF_SHAPES} == OF_A_LEAF


@pytest.mark.parametrize("generator", GENERATORS, ids=lambda generator: generator.name)
@pytest.mark.parametrize("sides", [3, 7])
def test_every_plant_of_so_many_triangles_is_within_the_budget(generator: Generator, sides: int) -> None:
    for plant in grown(generator, 6):
        budget = budget_of(triangles(plant, sides), sides, "auto")
        assert plant.n_vertices <= budget.vertices
        assert plant.n_leaves <= budget.leaves


def test_a_wish_for_an_outline_that_no_leaf_has_is_refused() -> None:
    with pytest.raises(ValueError, match="must be one of auto, broad"):
        Characteristics(leaf_outline="elm")
