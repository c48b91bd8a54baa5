"""Variations of the task grow: how seeds are written, a folder each, a sheet of all, and what fails."""

from __future__ import annotations

import json
from pathlib import Path
from typing import cast

import numpy as np
import pytest
import yaml
from PIL import Image

from experiments.command_check import check
from experiments.errors import UserError
from experiments.forest import write_forest
from experiments.seeds import read_seeds
from generators.simplegen import SimpleGen
from tests.experiments.program import finish
from treefit.asset import AssetSettings
from treefit.plant import Budget, Plant, Value, Values

SMALL: dict[str, Value] = {"levels": 2, "branch_count_0": 6}
PICTURES = AssetSettings(picture_size=64, sides=3, texture_size=0, lods=(1.0, 0.4))


class Ill(SimpleGen):
    """SimpleGen without a tree on even seeds, or on any."""

    odd = True

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        if seed % 2 == 0 or not self.odd:
            raise RuntimeError("the bark\nis loose")
        return super().__call__(values, seed, budget)


def forest(folder: Path, generator: SimpleGen, *seeds: int) -> dict[str, object]:
    return write_forest(folder, generator, generator.space.complete(SMALL), seeds, PICTURES, "elm")


@pytest.mark.parametrize(
    ("given", "seeds"),
    [("1..20", [*range(1, 21)]), ("3..3", [3]), (7, [7]), ("7", [7]), ([1, 2, 5], [1, 2, 5]),
     (["4..6", 9], [4, 5, 6, 9]), (None, None)],
)  # fmt: skip
def test_seeds_are_a_range_a_list_or_a_number(given: object, seeds: list[int] | None) -> None:
    assert read_seeds(given) == seeds


@pytest.mark.parametrize(
    ("given", "reason"),
    [("5..1", r"seeds: the last of 5\.\.1 must not be under the first"), ("-1", "seeds: must be whole numbers from 0"),
     ("oak", "must be whole numbers from 0, as 1..20 or .* got 'oak'"), ("1.5", "must be whole numbers"),
     ("true", "must be whole numbers"), ("[1,1]", r"must differ from each other, got \[1, 1\]"),
     ("[]", "1 to 1000 seeds, got 0"), ("1..2000", "1 to 1000 seeds, got 2000"),
     ("1..999999999999", "1 to 1000 seeds"), ("[[1]]", "must be whole numbers")],
)  # fmt: skip
def test_seeds_that_are_none_are_one_line(given: str, reason: str) -> None:
    with pytest.raises(UserError, match=reason) as error:
        check(["task=grow", f"seeds={given}"], sweep=False)
    assert "\n" not in str(error.value)


def test_each_seed_has_its_files_and_a_preset_that_grows_it_again(tmp_path: Path) -> None:
    facts = forest(tmp_path, SimpleGen(), 3, 5)
    assert facts["seeds"] == [3, 5]
    trees = cast(dict[str, dict[str, str]], facts["trees"])
    assert facts["failed"] == {}
    for seed in (3, 5):
        folder = tmp_path / "trees" / str(seed)
        assert {path.name for path in folder.iterdir()} == set(trees[str(seed)])
        assert {"tree.glb", "picture.png", "preset.yaml"} <= set(trees[str(seed)])
        preset = yaml.safe_load((folder / "preset.yaml").read_text(encoding="utf-8"))
        assert (preset["seed"], preset["values"]["levels"]) == (seed, 2)
    files = [(tmp_path / "trees" / str(seed) / "tree.glb").read_bytes() for seed in (3, 5)]
    assert files[0] != files[1]
    with Image.open(tmp_path / "sheet.png") as sheet:
        assert np.ptp(np.asarray(sheet.convert("RGB")).astype(int), axis=2).max() > 8


def test_a_seed_without_a_tree_is_named_and_the_others_are_written(tmp_path: Path) -> None:
    facts = forest(tmp_path, Ill(), 1, 2, 3)
    assert facts["failed"] == {"2": "the bark is loose"}
    assert sorted(path.name for path in (tmp_path / "trees").iterdir()) == ["1", "3"]


def test_seeds_that_have_no_tree_at_all_are_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Ill, "odd", False)
    with pytest.raises(UserError, match=r"seeds: none of the 2 has a tree: the bark is loose"):
        forest(tmp_path, Ill(), 1, 3)
    assert not [*tmp_path.iterdir()]


def test_grow_makes_variations_and_lists_their_files(tmp_path: Path) -> None:
    settings = ["task=grow", "seeds=4..5", "values={levels: 2, branch_count_0: 6}", "asset.picture_size=64",
                "asset.turntable=0", "asset.texture_size=64"]  # fmt: skip
    done = finish(tmp_path, f"hydra.run.dir={tmp_path / 'run'}", *settings)
    facts = json.loads(done.stdout.splitlines()[-1])
    assert list(facts["trees"]) == ["4", "5"]
    files = [facts["sheet"], *(path for tree in facts["trees"].values() for path in tree.values())]
    assert all(Path(path).is_file() for path in files)
