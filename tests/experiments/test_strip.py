"""The growth strip of the task grow: which years it shows, at one scale, and what happens where nothing grows."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from PIL import Image

from experiments.command_check import check
from experiments.errors import UserError
from experiments.settings import Strip
from experiments.sheet_cells import same
from experiments.strip import FRAMES, moments, write_strip
from experiments.strip_animation import PAUSE, STEP, durations, write_animation
from experiments.strip_growth import Growth, shown_parameter
from experiments.strip_page import WIDEST, strip_page
from experiments.strip_rows import Place, arranged
from generators.simplegen import SimpleGen
from tests.experiments.program import finish
from treefit.asset import AssetSettings
from treefit.plant import Budget, Parameter, ParameterSpace, Plant, Preset, Value, Values
from treefit.plant.extent import extent_of

AGE = Parameter("age", 10, 24, 18, "years", kind="int", least=1)
SMALL: dict[str, Value] = {"levels": 2, "branch_count_0": 6, "branching_start_0": 0.5}
MASKS = Strip(look="mask", height=100)


@dataclass(frozen=True)
class Growing:
    """SimpleGen, a metre larger every year to its 12th; it is ill in the years of `ill`."""

    ill: tuple[int, ...] = ()
    name: str = "growing"
    version: str = "1"
    parallel: str = "threads"
    pure: bool = True
    size_parameter: str | None = None
    age_parameter: str | None = "age"
    family: Path | None = None
    presets: ClassVar[Mapping[str, Preset]] = {}

    @property
    def space(self) -> ParameterSpace:
        return ParameterSpace((AGE, *SimpleGen().space.parameters))

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        age = values["age"]
        assert isinstance(age, int)
        if age in self.ill:
            raise RuntimeError("the bark\nis loose")
        plain = {name: value for name, value in values.items() if name != "age"}
        return SimpleGen()({**plain, "branch_len_0": float(min(age, 12)), "leaf_number": 0}, seed, budget)


def growth(generator: Growing | None = None, **values: Value) -> Growth:
    generator = generator or Growing()
    return Growth(generator, AGE, generator.space.complete({**SMALL, **values}), 3)


def written(folder: Path, of: Growth, settings: Strip) -> tuple[list[str], list[str]]:
    return write_strip(folder, of, settings, AssetSettings(picture_size=64), "elm")


def test_years_rise_from_the_first_to_that_which_ends_the_growth() -> None:
    assert growth().spaced(FRAMES) == [1, 3, 4, 6, 7, 9, 10, 12]
    assert growth(age=9).spaced(3) == [1, 5, 9]
    assert growth().spaced(1) == [12]


@pytest.mark.parametrize("age", [1, 2, 5, 11, 12, 13, 40])
def test_no_year_is_shown_twice_and_the_last_is_the_tree_itself(age: int) -> None:
    tree = growth(age=age)
    years = tree.spaced(60)
    assert years == list(range(1, min(age, 12) + 1))
    assert same(tree.at(years[-1]), tree.at(age))
    assert isinstance(tree.at(age), Plant)


def test_a_plant_is_grown_once_a_year() -> None:
    tree = growth()
    assert tree.at(7) is tree.at(7.0)


def test_captions_tell_year_height_vertices_and_leaves() -> None:
    (moment,) = moments(growth(), [7])
    assert isinstance(moment.plant, Plant)
    tall = f"{extent_of(moment.plant).height:.1f} m"
    assert (moment.name, *moment.facts) == ("year 7", tall, f"{moment.plant.n_vertices} vertices", "0 leaves")


def test_heights_in_pixels_follow_metres_on_one_ground() -> None:
    tree = growth()
    shown = moments(tree, [3, 6, 12])
    page = np.asarray(strip_page(shown, MASKS, AssetSettings(), "", ""))
    bark = np.ptp(page, axis=2) > 8  # all else is white and grey
    columns = np.flatnonzero(bark.any(axis=0))
    plants = np.split(columns, np.flatnonzero(np.diff(columns) > 12) + 1)
    rows = [np.flatnonzero(bark[:, part].any(axis=1)) for part in plants]
    assert len(rows) == 3
    assert np.ptp([row[-1] for row in rows]) <= 1
    tall = [row[-1] - row[0] + 1 for row in rows]
    metres = [extent_of(moment.plant).height for moment in shown if isinstance(moment.plant, Plant)]
    assert np.divide(tall, metres) * metres[-1] == pytest.approx(tall[-1], abs=8)
    assert tall[-1] == pytest.approx(84, abs=2)


def test_the_strip_and_the_film_are_written_as_asked(tmp_path: Path) -> None:
    assert written(tmp_path, growth(age=4), MASKS) == (["strip.png"], [])
    assert written(tmp_path, growth(age=4), Strip(frames=0)) == ([], [])
    assert written(tmp_path, growth(age=4), Strip(frames=0, animation=True)) == (["growth.webp"], [])
    with Image.open(tmp_path / "growth.webp") as film:
        assert getattr(film, "n_frames", 1) == 4
        assert film.height == 64
    both, one = (strip_page(moments(growth(), [1, 5]), replace(MASKS, look=look), AssetSettings(), "", "")
                 for look in ("both", "shaded"))  # fmt: skip
    assert both.width == one.width
    assert both.height > one.height + 100


def test_equal_plants_make_equal_bytes(tmp_path: Path) -> None:
    pages = []
    for _ in range(2):
        written(tmp_path, growth(age=5), Strip(frames=3, height=64, animation=True))
        pages.append([(tmp_path / name).read_bytes() for name in ("strip.png", "growth.webp")])
    assert pages[0] == pages[1]


def test_an_ill_year_is_an_empty_place_with_its_reason(tmp_path: Path) -> None:
    ill = growth(Growing(ill=(5,)), age=9)
    assert written(tmp_path, ill, replace(MASKS, frames=3, animation=True)) == (
        ["strip.png", "growth.webp"], ["year 5: the bark is loose"],
    )  # fmt: skip
    with Image.open(tmp_path / "growth.webp") as film:
        assert getattr(film, "n_frames", 1) == 8
    dead = growth(Growing(ill=tuple(range(20))), age=3)
    names, failed = written(tmp_path, dead, replace(MASKS, animation=True))
    assert names == ["strip.png"]
    assert failed == [f"year {year}: the bark is loose" for year in (1, 2, 3)]


def test_a_plant_that_cannot_be_drawn_is_no_end_either(tmp_path: Path) -> None:
    grown = growth().at(5)
    assert isinstance(grown, Plant)
    nothing = replace(grown, position=0 * grown.position)
    shown = [
        replace(moment, plant=plant) for moment, plant in zip(moments(growth(), [4, 5]), (nothing, grown), strict=True)
    ]
    assert write_animation(tmp_path / "growth.webp", shown, AssetSettings(picture_size=64))
    with Image.open(tmp_path / "growth.webp") as film:
        assert getattr(film, "n_frames", 1) == 1
    assert not write_animation(tmp_path / "none.webp", shown[:1], AssetSettings(picture_size=64))
    assert strip_page(shown, Strip(height=64), AssetSettings(), "", "").width > 500


def test_rows_are_of_one_width_and_about_equally_full() -> None:
    places = [Place(30, 40)] * 11
    rows = arranged(places, (40, 10), 400, 100)
    assert [(row.first, row.last) for row in rows] == [(0, 4), (4, 8), (8, 11)]
    assert {row.width for row in rows} == {50 + 4 * 70}
    assert rows[0].trunks == pytest.approx((70, 140, 210, 280), abs=1)
    assert all(40 < trunk < row.width - 10 for row in rows for trunk in row.trunks)
    (narrow,) = arranged(places[:1], (40, 10), 400, 300)
    assert (narrow.width, narrow.trunks) == (300, pytest.approx((160,)))
    (wide,) = arranged([Place(900, 900)], (40, 10), 400, 100)
    assert wide.width == 1850


def test_many_years_go_on_below_and_no_page_is_too_wide() -> None:
    page = strip_page(moments(growth(age=12), range(1, 13)), replace(MASKS, height=1024), AssetSettings(), "", "")
    assert page.width <= WIDEST
    assert page.height > 1024 + 512


def test_a_film_slows_down_and_rests_at_its_end() -> None:
    times = durations(20)
    assert times[:15] == [STEP] * 15
    assert times[14:] == sorted(times[14:])
    assert times[-1] == PAUSE
    assert durations(1) == [PAUSE]


def test_any_number_can_be_shown_from_its_lowest_value_to_the_trees() -> None:
    generator = SimpleGen()
    parameter = shown_parameter(generator, Strip(parameter="lean"))
    assert parameter is not None
    lean = Growth(generator, parameter, generator.space.complete({**SMALL, "lean": parameter.high / 2}), 0)
    assert lean.spaced(5) == pytest.approx(np.linspace(parameter.low, parameter.high / 2, 5))
    assert not lean.by_year


def test_what_has_no_years_has_no_strip_unless_it_is_asked_for() -> None:
    assert shown_parameter(SimpleGen(), Strip()) is None
    assert shown_parameter(SimpleGen(), Strip(frames=0)) is None
    assert shown_parameter(Growing(), Strip()) is AGE


@pytest.mark.parametrize(("setting", "message"), [
    ("strip.frames=5", "strip: simplegen does not grow by years; strip.parameter=<name> shows another way"),
    ("strip.animation=true", "strip: simplegen does not grow by years"),
    ("strip.parameter=leen", "strip.parameter: no parameter: 'leen'; did you mean 'lean'?"),
    ("strip.frames=61", "strip.frames: must be less than or equal to 60, got 61"),
    ("strip.height=8", "strip.height: must be greater than or equal to 64, got 8"),
    ("strip.look=sketch", "strip.look: must be 'shaded', 'mask' or 'both', got 'sketch'"),
])  # fmt: skip
def test_a_wrong_setting_is_told_before_anything_grows(setting: str, message: str) -> None:
    with pytest.raises(UserError) as caught:
        check(["task=grow", setting], sweep=False)
    assert message in str(caught.value)


def test_the_task_writes_the_strip_beside_the_tree_and_tells_it(tmp_path: Path) -> None:
    done = finish(tmp_path, "task=grow", "hydra.run.dir=out", "strip.parameter=branch_len_0", "strip.frames=3",
                  "strip.height=64", "values={levels: 2, branch_count_0: 6}", "asset.lods=[]",
                  "asset.turntable=0")  # fmt: skip
    told = json.loads(done.stdout.splitlines()[-1])
    assert {"tree.glb", "picture.png", "preset.yaml", "strip.png"} == set(told["files"])
    assert told["strip_failed"] == []
    with Image.open(told["files"]["strip.png"]) as page:
        assert page.mode == "RGB"
