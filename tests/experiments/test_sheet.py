"""The task sheet: cells at one scale, values of a row, pages, and what cannot be drawn."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from experiments.command_check import check
from experiments.errors import UserError
from experiments.sheet import parameter_rows, preset_blocks
from experiments.sheet_cells import BUDGET, Cell, Drawing, grow
from experiments.sheet_paper import wrapped
from experiments.sheet_parameters import ROWS, Row, parameter_pages
from experiments.sheet_presets import preset_pages
from experiments.sheet_shown import first_shown, stages
from experiments.sheet_values import choose, nearest, steps, written
from generators.simplegen import SimpleGen
from tests.experiments.program import finish
from tests.failing import Failing
from treefit.asset import AssetSettings
from treefit.asset.pictures.font import fitted, font
from treefit.asset.pictures.frame import BASE_SHARE
from treefit.plant import Parameter, ParameterSpace, Plant, Preset, Value

MASKS, BOTH = Drawing(AssetSettings(), "mask", 100, 100), Drawing(AssetSettings(), "both", 100, 60)
SMALL: dict[str, Value] = {"levels": 3, "branch_count_0": 8}


class Named(SimpleGen):
    """SimpleGen with plants of its own."""

    presets: ClassVar[Mapping[str, Preset]] = {
        name: Preset("simplegen", "2", 0, values)
        for name, values in {
            "ash": {**SMALL, "whorl": 2}, "elm": {**SMALL, "whorl": 5},
            "fir": {**SMALL, "levels": 4, "branch_count_0": 16},
            "jungle": {"levels": 4, "branch_count_0": 400, "branch_count_1": 90, "branch_count_2": 70},
            "oak": {**SMALL, "levels": 4},
        }.items()
    }  # fmt: skip


def usual() -> dict[str, Value]:
    return SimpleGen().space.complete(SMALL)


def plant(**values: Value) -> Plant:
    grown = grow(SimpleGen(), {**usual(), **values}, 0)
    assert isinstance(grown, Plant)
    return grown


def rows_of_ink(panel: NDArray[np.uint8] | None) -> NDArray[np.intp]:
    assert panel is not None
    return np.flatnonzero((panel < 200).any(axis=(1, 2)))


def test_numbers_have_five_values_in_equal_steps_of_the_gene() -> None:
    assert steps(Parameter("x", 0, 8)) == [0, 2, 4, 6, 8]
    assert steps(Parameter("x", 1, 16, 1, scale="log")) == pytest.approx([1, 2, 4, 8, 16])
    assert steps(Parameter("x", 2, 4, 2, kind="int")) == [2, 3, 4]
    assert steps(Parameter("x", default=True, kind="bool")) == [False, True]
    assert steps(Parameter("x", default="a", kind="choice", choices=tuple("abcdefg"))) == list("abcdefg")


def test_the_marked_value_is_nearest_in_the_gene() -> None:
    number = Parameter("x", 1, 16, 1, scale="log")
    assert nearest(number, steps(number), 5.5) == 2  # 4 in the gene, though 6 to 8 would be as near as numbers
    assert nearest(number, steps(number), 100) == 4
    choice = Parameter("x", default="a", kind="choice", choices=("a", "b", "c"))
    assert nearest(choice, steps(choice), "c") == 2


def test_values_are_written_for_people() -> None:
    told = [written(-0.12345, "deg"), written(1234.5, "m"), written(7, "1"), written(True, ""), written("oak", "1")]
    assert told == ["−0.123°", "1,234 m", "7", "yes", "oak"]


def test_parameters_are_chosen_in_their_own_order() -> None:
    space = ParameterSpace((Parameter("a"), Parameter("b"), Parameter("c")), {"b": 0.0})
    assert [one.name for one in choose(space, None)] == ["a", "b", "c"]
    assert [one.name for one in choose(space, ["c", "a"])] == ["a", "c"]


@pytest.mark.parametrize(("setting", "message"), [
    ("sheet.names=[leaf_sise]", "sheet.names: no parameter 'leaf_sise'; did you mean 'leaf_size'"),
    ("sheet.names=[]", "sheet.names: "),
    ("sheet.look=sketch", "sheet.look: must be 'shaded', 'mask' or 'both', got 'sketch'"),
    ("sheet.height=8", "sheet.height: must be greater than or equal to 64, got 8"),
    ("preset=oak", "preset: neither a file nor a plant of simplegen: 'oak'"),
    ("++values.whirl=3", "values: no parameter 'whirl'; did you mean 'whorl'?"),
])  # fmt: skip
def test_a_wrong_setting_is_told_before_anything_is_drawn(setting: str, message: str) -> None:
    with pytest.raises(UserError) as caught:
        check(["task=sheet", setting], sweep=False)
    assert message in str(caught.value)


def test_plants_of_a_row_are_at_one_scale_on_one_baseline() -> None:
    low, high = MASKS.row([plant(branch_len_0=5.0), plant(branch_len_0=10.0)])
    one, two = rows_of_ink(low.mask), rows_of_ink(high.mask)
    assert two[-1] == one[-1] == pytest.approx(BASE_SHARE * 100, abs=1)
    assert two[-1] - two[0] == pytest.approx(2 * (one[-1] - one[0]), abs=3)
    assert two[0] > 0


def test_pictures_are_at_the_scale_of_the_masks() -> None:
    drawing = Drawing(AssetSettings(bark="black"), "both", 200, 200)
    for cell in drawing.row([plant(branch_len_0=size, leaf_number=0) for size in (5.0, 10.0)]):
        assert cell.shaded is not None
        dark = np.flatnonzero((cell.shaded.max(axis=2) < 90).any(axis=1))
        ink = rows_of_ink(cell.mask)
        assert (dark[0], dark[-1]) == (pytest.approx(ink[0], abs=8), pytest.approx(ink[-1], abs=2))


def test_the_widest_plant_fits_into_its_cell() -> None:
    for cell in MASKS.row([plant(branch_len_1=1.2, branching_start_0=0.05), plant()]):
        assert cell.mask is not None
        assert (cell.mask[:, [0, -1]] == 255).all()


def test_a_look_has_the_panels_that_it_names() -> None:
    (both,), (mask,) = BOTH.row([plant()]), MASKS.row([plant()])
    assert both.shaded is not None
    assert both.mask is not None
    assert [both.shaded.shape[:2], both.mask.shape[:2]] == list(BOTH.sizes)
    assert mask.shaded is None


def test_what_cannot_grow_is_a_reason_and_no_end() -> None:
    values = {**usual(), "wobble": 0.0}
    assert grow(Failing(), values, 0) == "the bark is loose"
    assert grow(Failing(how="nan"), values, 0) == "plant: radius has NaN or infinite values"
    huge = {"levels": 4, "branch_count_0": 400, "branch_count_1": 90, "branch_count_2": 70}
    assert f"cut at {BUDGET.vertices:,} vertices" in str(grow(SimpleGen(), {**usual(), **huge}, 0))
    cells = MASKS.row(["the bark is loose", plant(), "cut"])
    assert [cell.failure for cell in cells] == ["the bark is loose", "", "cut"]
    assert MASKS.row(["all", "fail"]) != []


def test_a_parameter_without_a_say_is_unseen_and_others_are_not() -> None:
    names = ["branch_len_3", "whorl", "lean"]  # there is no level 3
    rows = parameter_rows(SimpleGen(), BOTH, names, usual(), 0)
    assert {row.parameter.name: row.unseen for row in rows} == {"branch_len_3": True, "whorl": False, "lean": False}
    assert len({id(cell) for cell in rows[0].cells}) == 1  # drawn once
    assert not Row(rows[0].parameter, 0.4, False, [0.2, 0.4], [rows[0].cells[0], Cell(failure="cut")]).unseen


def test_what_shows_nothing_at_the_usual_values_is_shown_on_the_simplest_preset_that_has_it() -> None:
    (row,) = parameter_rows(Named(), BOTH, ["branch_len_3"], usual(), 0)
    assert (row.on, row.unseen) == ("oak", False)  # ash and elm have no level 3, fir has more vertices
    oak = Named().space.complete(Named.presets["oak"].values)
    assert row.usual == oak["branch_len_3"]
    plants = [grow(Named(), {**oak, "branch_len_3": value}, 0) for value in row.values]
    assert all(one.looks_like(two) for one, two in zip(row.cells, BOTH.row(plants), strict=True))
    (plain,) = parameter_rows(Named(), BOTH, ["whorl"], usual(), 0)
    assert (plain.on, plain.usual) == ("", usual()["whorl"])
    (page,), (other,) = (parameter_pages([replace(row, on=on)], BOTH.sizes, "", "") for on in ("oak", ""))
    assert np.any(np.asarray(page) != np.asarray(other))  # its head says where


def test_stages_are_light_presets_from_the_simplest_on() -> None:
    ready = stages(Named(), 0)
    counts = [stage.n_vertices for stage in ready]
    assert counts == sorted(counts)
    assert {stage.name for stage in ready} == set(Named.presets) - {"jungle"}


def test_a_parameter_that_shows_on_no_preset_is_unseen() -> None:
    space = SimpleGen().space
    level = next(parameter for parameter in space.parameters if parameter.name == "branch_len_3")
    ready = [stage for stage in stages(Named(), 0) if stage.name in ("ash", "elm")]
    assert len(ready) == 2
    assert first_shown(Named(), level, steps(level), ready, 0) is None


def test_a_fixed_parameter_is_shown_too() -> None:
    (row,) = parameter_rows(SimpleGen(), MASKS, ["branch_len_0"], usual(), 0)
    assert row.fixed
    assert not row.unseen


def test_pages_are_about_equally_long_and_hold_every_row() -> None:
    parameter, cell = Parameter("x", doc="word " * 99), Cell(failure="no reason " * 30)
    row = Row(parameter, 0.5, True, steps(parameter), [cell] * 5)
    pages = parameter_pages([row] * (ROWS + 2), MASKS.sizes, "title", "legend")
    assert len(pages) == 2
    assert pages[0].size == pages[1].size
    (single,) = parameter_pages([row] * 2, BOTH.sizes, "title", "legend")
    assert single.width > pages[0].width


def test_many_choices_go_on_below() -> None:
    choice = Parameter("x", default="a", kind="choice", choices=tuple("abcdefg"))
    one, two = (Row(choice, "a", False, steps(choice)[:n], [Cell(failure="-")] * n) for n in (5, 7))
    pages = [parameter_pages([row], MASKS.sizes, "", "")[0] for row in (one, two)]
    assert pages[0].width == pages[1].width
    assert pages[1].height - pages[0].height > 100


def test_presets_are_shown_on_each_seed_with_their_counts() -> None:
    blocks = preset_blocks(Named(), MASKS, range(3, 5))
    elm, jungle = blocks[1], blocks[3]
    assert [block.name for block in blocks] == sorted(Named.presets)
    grown = grow(Named(), Named().space.complete(Named.presets["elm"].values), 4)
    assert isinstance(grown, Plant)
    assert elm.captions[1][1:] == (f"{grown.n_vertices:,} vertices", f"{grown.n_leaves:,} leaves")
    assert elm.captions[1][0].startswith("seed 4 · ")
    assert not elm.cells[0].looks_like(elm.cells[1])
    assert "cut at" in jungle.cells[0].failure
    (page,) = preset_pages(blocks, MASKS.sizes, "title", "legend")
    assert page.width > 4 * MASKS.sizes[0][1]  # beside each other


def test_text_keeps_to_its_room() -> None:
    lines = wrapped("one two three four five sixsixsixsixsixsixsixsixsix", 12, 80, 3)
    assert len(lines) == 3
    assert all(font(12).getlength(line) <= 80 for line in [*lines, fitted("w" * 50, 12, 80)])
    assert lines[-1].endswith("…")
    assert wrapped("all of it", 12, 80, 3) == ["all of it"]


def test_the_task_writes_its_pages_and_tells_them_last(tmp_path: Path) -> None:
    done = finish(tmp_path, "task=sheet", "hydra.run.dir=out", "sheet.height=64", "sheet.names=[branch_len_3, whorl]",
                  "values={levels: 3}")  # fmt: skip
    told = json.loads(done.stdout.splitlines()[-1])
    assert told["files"] == [str(tmp_path / "out" / "parameters.png")]
    assert (told["unseen"], told["failed"]) == (["branch_len_3"], [])
    assert "has no presets" in (tmp_path / "out" / "run.log").read_text(encoding="utf-8")
    with Image.open(told["files"][0]) as page:
        assert page.mode == "RGB"
