"""The task adapt: random trees of a pretended generator, what each parameter does, files, and a run of a program."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from experiments.adapt import adapt
from experiments.adapting.beginning import Beginning, Foreign, beginning
from experiments.adapting.ends import failing_ends, reasons
from experiments.adapting.findings import Findings, as_facts
from experiments.adapting.rounds import try_rounds
from experiments.adapting.settings import Adapt
from experiments.adapting.space import DEAD, SIZE
from experiments.adapting.trial import try_genomes
from experiments.adapting.yaml import space_text
from experiments.command_check import check
from experiments.errors import UserError
from generators.external.space import read_space
from tests.experiments.program import finish, run_program
from treefit.plant import Budget, ParameterSpace, Plant, Preset, Values

PRESET = {"trunk": {"height": 10.0, "radius": 0.3}, "reach": 3.0, "unit": 1.0, "idle": 5.0, "brittle": 1.0, "seed": 4}
NOTHING, SMALL = ParameterSpace(()), Adapt(plants=60, moved=2)


@dataclass
class Pretended:
    """A trunk with two arms; fails where brittle is over `breaks`."""

    breaks: float = 1.7
    steady: bool = True
    space: ParameterSpace = NOTHING
    name: str = "pretended"
    version: str = "1"
    parallel: str = "threads"
    size_parameter: str | None = None
    age_parameter: str | None = None
    family: Path | None = None
    presets: Mapping[str, Preset] = ()  # type: ignore[assignment]
    calls: int = 0

    def ask_preset(self) -> Mapping[str, object] | None:
        return PRESET

    def with_space(self, space: ParameterSpace) -> Pretended:
        return replace(self, space=space)

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        self.calls += 1
        if float(values["brittle"]) > self.breaks:
            raise ArithmeticError("it\nbroke")
        high, wide, thick, unit = (float(values[name]) for name in ("trunk.height", "reach", "trunk.radius", "unit"))
        wide += 0.0 if self.steady else self.calls
        position = np.array([[0, 0, 0], [0, 0, high], [wide, 0, high / 2], [-wide, 0, high]], np.float32)
        none = np.zeros((0, 3), np.float32)
        radius = np.full(4, thick * unit, np.float32)
        return Plant(position * np.float32(unit), radius, np.array([-1, 0, 0, 1], np.int32),
                     np.array([0, 0, 1, 1], np.int32), none, none, none, none[:, :2])  # fmt: skip


def start(generator: Foreign, settings: Adapt = SMALL) -> Beginning:
    return beginning(generator, settings, False, {})


def found(generator: Pretended) -> Findings:
    return adapt(generator, start(generator), SMALL, 0)


def test_the_dead_is_fixed_and_what_scales_the_tree_is_found() -> None:
    told = found(Pretended(breaks=9))
    assert {one.name: one.reason for one in told.fixed} == {"unit": SIZE, "idle": DEAD, "brittle": DEAD}
    assert told.size_parameter == "unit"
    assert {one.name for one in told.searched} == {"trunk.height", "trunk.radius", "reach"}
    assert told.effects["unit"].most < 0.02 < 0.1 < told.effects["reach"].mean <= told.effects["reach"].most <= 1
    assert [one.name for one in told.proposals if one.left_out] == ["seed"]
    assert (told.repeated, told.before, told.trial.share) == ((5, 5), [], 1.0)


def test_failures_are_counted_and_the_end_at_fault_is_named() -> None:
    tried = try_rounds(Pretended(), start(Pretended()).proposals, 100, 0, 1)
    bad = 100 - len(tried.trial.good)
    assert reasons(tried.trial) == [(bad, "ArithmeticError", "it broke")]
    assert 10 < bad < 40
    ends = failing_ends(tried.trial)
    assert {name: end.at_fault for name, end in ends.items() if end.at_fault} == {"brittle": "high"}
    assert ends["brittle"].low == 0


def test_ranges_in_which_too_few_grow_become_narrower_where_they_fail() -> None:
    tried = try_rounds(Pretended(breaks=1.1), start(Pretended()).proposals, 100, 0)
    assert [(one.share < 0.8, one.narrowed) for one in tried.before] == [(True, ["brittle"])] * len(tried.before)
    assert len(tried.before) in (1, 2)
    assert tried.trial.share >= 0.8
    assert tried.before[0].failures[0][1:] == ("ArithmeticError", "it broke")
    before, after = ({one.name: one.parameter for one in proposals}
                     for proposals in (start(Pretended()).proposals, tried.proposals))  # fmt: skip
    assert {name for name in after if after[name] != before[name]} == {"brittle"}
    narrow = after["brittle"]
    assert narrow is not None
    assert (narrow.low, narrow.high < 1.5) == (0.5, True)


def test_a_generator_of_which_nothing_grows_ends_early_with_the_reason() -> None:
    broken = Pretended(breaks=0)
    with pytest.raises(
        UserError, match=r"neither the example nor 20 random trees grew: ArithmeticError \(20 times\): it"
    ):
        found(broken)


def test_a_tree_that_is_another_one_the_next_time_is_told() -> None:
    assert found(Pretended(breaks=9, steady=False)).repeated[0] == 0


def test_random_trees_do_not_depend_on_how_many_there_are() -> None:
    generator = Pretended().with_space(try_rounds(Pretended(), start(Pretended()).proposals, 20, 0, 1).trial.space)
    few, many = (try_genomes(generator, range(7, 7 + count), "trees") for count in (3, 8))
    assert np.array_equal(few.genomes, many.genomes[:3])
    assert [tree.seed for tree in few.trees] == [7, 8, 9]


def test_the_written_space_reads_back_with_a_comment_for_every_parameter(tmp_path: Path) -> None:
    told = found(Pretended())
    text = space_text(told, "python run.py")
    (tmp_path / "space.yaml").write_text(text, encoding="utf-8")
    space = read_space(tmp_path / "space.yaml")
    assert space.names == ("trunk.height", "trunk.radius", "reach")
    assert space.fixed == {"unit": 1.0, "idle": 5.0, "brittle": 1.0}
    assert space.release("unit").names == ("trunk.height", "trunk.radius", "reach", "unit")
    lines = text.splitlines()
    above = [lines[i - 1] for i, line in enumerate(lines) if line.startswith("  - {")]
    assert all(line.startswith("  # example ") and "% of the picture" in line for line in above)
    assert any("0% fail when it is low" in line for line in above)
    json.dumps(as_facts(told), allow_nan=False)


def test_names_and_texts_that_yaml_would_misread_are_read_back(tmp_path: Path) -> None:
    odd = {
        "on": 2.0,
        "a: b #c": "no",
        "1": 3.0,
        "line\nend": 1.5,
        "empty": "",
        **{f"x.{i}": 1e-5 * (i + 1) for i in range(2)},
    }
    told = found(Pretended(breaks=9))
    example = beginning(_With({**PRESET, **odd}), SMALL, False, {})
    text = space_text(replace(told, proposals=example.proposals), "python run.py 'a\nb'")
    (tmp_path / "space.yaml").write_text(text, encoding="utf-8")
    space = read_space(tmp_path / "space.yaml")
    assert {p.name: p.default for p in space.parameters if p.name in odd} == odd


class _With(Pretended):
    """Pretended with another preset."""

    def __init__(self, preset: Mapping[str, object] | None) -> None:
        super().__init__()
        self.preset = preset

    def ask_preset(self) -> Mapping[str, object] | None:
        return self.preset


def test_without_a_preset_and_an_example_both_ways_are_told() -> None:
    with pytest.raises(UserError, match=r'give adapt.example=preset.json, or let it answer .*"ask": "preset"'):
        start(_With(None))


PROGRAM = """
import json, struct, sys
for line in sys.stdin:
    asked = json.loads(line)
    if asked.get("ask") == "preset":
        values = {"height": 8.0, "reach": 2.0, "seed": 3}
        print(json.dumps({"id": asked["id"], "ok": True, "values": values}), flush=True)
        continue
    import numpy as np
    v = asked["values"]
    position = np.array([[0, 0, 0], [0, 0, v["height"]], [v["reach"], 0, v["height"] / 2]], np.float32)
    np.savez(asked["out"] + ".npz", position=position, parent=np.array([-1, 0, 0]), radius=np.full(3, 0.2))
    print(json.dumps({"id": asked["id"], "ok": True}), flush=True)
"""


def test_a_run_writes_a_space_that_the_next_command_names(tmp_path: Path) -> None:
    (tmp_path / "my tree.py").write_text(PROGRAM, encoding="utf-8")
    program = ["generator=external", f"generator.command=[{sys.executable},'my tree.py']"]
    done = finish(
        tmp_path, "task=adapt", *program, "hydra.run.dir=out", "adapt.plants=20", "adapt.moved=1", "adapt.shown=2"
    )
    assert "20 of 20 random genomes grow one (100%)" in done.stdout
    last = done.stdout.splitlines()[-1]
    assert last.startswith("next     python run.py generator=external 'generator.command=[")
    assert last.endswith("generator.space=out/space.yaml image=pine.png")
    assert [p.name for p in read_space(tmp_path / "out" / "space.yaml").free] == ["height", "reach"]
    told = json.loads((tmp_path / "out" / "adapt.json").read_text(encoding="utf-8"))
    assert (told["grew"], told["same_again"], told["failures"]) == (20, [5, 5], [])
    with Image.open(tmp_path / "out" / "plants.png") as sheet:
        assert sheet.width > 400


def test_wrong_settings_are_told_before_anything_is_asked() -> None:
    for setting, message in (
        ("adapt.example=none.json", "adapt.example: no such file: none.json"),
        ("adapt.plants=3", "adapt.plants: must be greater than or equal to 20, got 3"),
        ("adapt.ranges=my", "adapt.ranges: must be 'auto', 'propose' or 'keep', got 'my'"),
    ):
        with pytest.raises(UserError, match=message):
            check(["task=adapt", setting], sweep=False)


def test_a_file_that_is_no_example_ends_the_run_on_one_line(tmp_path: Path) -> None:
    (tmp_path / "bad (1).json").write_text("{", encoding="utf-8")
    program = ["generator=external", f"generator.command=[{sys.executable},-c,pass]"]
    done = run_program(tmp_path, "task=adapt", "hydra.run.dir=out", *program, "adapt.example=bad (1).json")
    assert done.status == 2
    assert "bad (1).json is no JSON file (line 1" in done.stderr
    assert len(done.stderr.splitlines()) == 1
    assert not (tmp_path / "out").exists()
