"""The setting preset: a file, or a plant of the generator by name."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import ClassVar

import pytest
import yaml

from experiments.command_check import check
from experiments.errors import UserError
from experiments.preset import find_preset
from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from tests.experiments.program import finish
from treefit.plant import Preset, write_preset


class Named(SimpleGen):
    """SimpleGen with two plants of its own, kept since an older version."""

    presets: ClassVar[Mapping[str, Preset]] = {
        "poplar": Preset("simplegen", "1", 4, {"whorl": 4}),
        "bad": Preset("simplegen", "1", 4, {"whorl": 1.5}),
    }


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def write(name: str, generator: str = "simplegen") -> None:
    write_preset(name, generator=generator, version="0", seed=9, values={"whorl": 2})


def test_a_plant_of_the_generator_is_found_by_name_and_is_of_its_version() -> None:
    assert find_preset("poplar", Named()) == Preset("simplegen", Named.version, 4, {"whorl": 4})


def test_a_file_comes_before_a_plant_of_that_name() -> None:
    write("poplar")
    assert find_preset("poplar", Named()) == Preset("simplegen", "0", 9, {"whorl": 2})


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("popler", r"a plant of simplegen: 'popler'; did you mean 'poplar'\? \(there is: bad, poplar\)"),
        ("othr.yaml", r"no such file: othr.yaml; did you mean 'other.yaml'\?"),
        ("other.yaml", "made by gegen; add generator=gegen"),
        ("bad", "bad: parameter 'whorl': must be a whole number, got 1.5"),
    ],
)  # fmt: skip
def test_a_wrong_preset_is_one_clear_line(name: str, message: str) -> None:
    write("other.yaml", generator="gegen")
    with pytest.raises(UserError, match=f"^preset: .*{message}") as caught:
        find_preset(name, Named())
    assert "\n" not in str(caught.value)


def test_the_preset_is_checked_before_anything_runs() -> None:
    check(["task=grow", "generator=weberpenn", "preset=quaking_aspen"], sweep=False)
    check(["task=grow", "generator=weberpenn", "preset=quaking_aspen,sugar_maple"], sweep=True)
    with pytest.raises(UserError, match=r"preset: .*did you mean 'quaking_aspen'"):
        check(["task=grow", "generator=weberpenn", "preset=quaking_aspn"], sweep=False)
    with pytest.raises(UserError, match=r"preset: .*of simplegen: 'quaking_aspen' \(there is: nothing\)"):
        check(["task=grow", "preset=quaking_aspen"], sweep=False)


def test_grow_takes_a_preset_by_name_on_another_seed(tmp_path: Path) -> None:
    done = finish(tmp_path, "hydra.run.dir=out", "task=grow", "generator=weberpenn", "preset=quaking_aspen", "seed=8",
                  "asset.picture_size=64", "asset.lods=[]", "asset.turntable=0", "values={levels: 2}")  # fmt: skip
    assert done.stderr == ""
    facts = json.loads(done.stdout.splitlines()[-1])
    assert (facts["seed"], facts["generator"]) == (8, "weberpenn")
    written = yaml.safe_load(Path("out/preset.yaml").read_text(encoding="utf-8"))
    own = find_preset("quaking_aspen", WeberPennGen())
    assert written["values"] == {**written["values"], **own.values, "levels": 2}
