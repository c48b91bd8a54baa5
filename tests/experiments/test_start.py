"""The setting start and the memory of earlier fits, from names to the first genomes of a search."""

from __future__ import annotations

import json
import logging
from pathlib import Path

import numpy as np
import pytest
import yaml

from experiments.beginning import remember, start_of
from experiments.command_check import check
from experiments.command_line import prepare
from experiments.errors import UserError
from experiments.start import find_start
from experiments.start_settings import MemorySettings
from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from tests.conftest import blob
from tests.experiments.program import finish
from treefit.candidates import judge
from treefit.fit import aim
from treefit.plant import write_preset
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Mix
from treefit.view import OrthographicView

SMALL = ["tracking=none", "optimizer.evaluations=200", "optimizer.generations=10", "characteristics.vertices=400",
         "view.resolution=64", "other_seeds=0", "candidates.count=1", "asset.picture_size=64",
         "asset.texture_size=64", "asset.turntable=0", "asset.lods=[]"]  # fmt: skip


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def write(name: str, wobble: float, generator: str = "simplegen", **values: float) -> None:
    Path(name).parent.mkdir(parents=True, exist_ok=True)
    write_preset(name, generator=generator, version="0", seed=9, values={"wobble": wobble, **values})


ON, OFF = MemorySettings(use=True), MemorySettings()


def wobbles(*names: str) -> list[object]:
    return [preset.values["wobble"] for preset in find_start(names, SimpleGen())]


def test_a_start_is_a_file_a_run_or_a_candidate_in_the_order_given() -> None:
    write("a.yaml", 0.01)
    for number in (1, 2, 10):
        write(f"outputs/my run/candidates/{number}/preset.yaml", 0.1 * number)
    assert wobbles("a.yaml") == [0.01]
    assert wobbles("outputs/my run", "a.yaml") == [0.1, 0.2, 1.0, 0.01]
    assert wobbles("outputs/my run/candidates/2") == [0.2]
    assert wobbles() == []


def test_a_plant_of_the_generator_is_found_by_name() -> None:
    generator = WeberPennGen()
    found = find_start(["sugar_maple", "quaking_aspen"], generator)
    assert [preset.values for preset in found] == [
        generator.presets[name].values for name in ("sugar_maple", "quaking_aspen")
    ]


@pytest.mark.parametrize(
    ("start", "message"),
    [
        ("other.yaml", "start: it was made by gegen; add generator=gegen"),
        ("lacks.yaml", "start: .*lacks.yaml: no parameter 'wobbel'; did you mean 'wobble'"),
        ("empty", "start: no candidates in the folder .*empty: give that of a run that came to its end"),
        ("nothing.yaml", "start: no such file: nothing.yaml"),
        ("oak", "start: neither a file nor a plant of simplegen: 'oak'"),
    ],
)  # fmt: skip
def test_a_wrong_start_is_one_clear_line_before_anything_runs(start: str, message: str) -> None:
    write("other.yaml", 0.1, "gegen")
    write("lacks.yaml", 0.1, wobbel=1.0)
    Path("empty").mkdir()
    with pytest.raises(UserError, match=message) as caught:
        check(prepare(["image=pine.png", f"start={start}"]), sweep=False)
    assert "\n" not in str(caught.value)


def test_names_with_spaces_and_lists_reach_the_setting() -> None:
    write("my run/candidates/1/preset.yaml", 0.1)
    write("a.yaml", 0.1)
    for start in ("my run", "[my run,a.yaml]", "a.yaml", "null", "[]"):
        check(prepare(["image=pine.png", f"start={start}"]), sweep=False)


def test_what_a_search_began_from_is_kept_for_a_resumed_one(caplog: pytest.LogCaptureFixture) -> None:
    write("a.yaml", 0.01)
    with caplog.at_level(logging.WARNING):
        assert start_of(["a.yaml"], OFF, SimpleGen(), blob(), Path()) == [{"wobble": 0.01}]
    assert ["version 0 of simplegen" in line.getMessage() for line in caplog.records] == [True]
    Path("a.yaml").unlink()
    assert start_of(["a.yaml"], OFF, SimpleGen(), blob(), Path()) == [{"wobble": 0.01}]
    assert start_of([], OFF, SimpleGen(), blob(), Path()) == []


def test_the_memory_comes_after_the_start_and_only_when_it_is_used(tmp_path: Path) -> None:
    objective = aim(blob(), SimpleGen(), Mix(), Characteristics(400), OrthographicView(resolution=64), 3)
    found = judge(objective, np.full(len(objective.space), 0.4), blob(), 0)
    remember(OFF, SimpleGen(), blob(), found)
    assert not Path("outputs").exists()
    remember(ON, SimpleGen(), blob(), found)
    write("a.yaml", 0.01)
    first, second = start_of(["a.yaml"], ON, SimpleGen(), blob(crown=0.3), tmp_path)
    assert first == {"wobble": 0.01}
    assert second == dict(found.values)


def test_a_memory_that_cannot_be_written_or_read_costs_one_line(caplog: pytest.LogCaptureFixture) -> None:
    Path("outputs").write_text("a file", encoding="utf-8")
    objective = aim(blob(), SimpleGen(), Mix(), Characteristics(400), OrthographicView(resolution=64), 3)
    found = judge(objective, np.full(len(objective.space), 0.4), blob(), 0)
    with caplog.at_level(logging.WARNING):
        assert start_of([], ON, SimpleGen(), blob(), Path()) == []
        remember(ON, SimpleGen(), blob(), found)
    assert [line.getMessage().partition(": ")[0] for line in caplog.records] == ["memory", "memory"]


@pytest.mark.slow
def test_a_second_fit_begins_where_the_first_one_ended(tmp_path: Path) -> None:
    def run(folder: str, *more: str) -> float:
        finish(tmp_path, f"hydra.run.dir={folder}", "image=pine.png", *SMALL, *more)
        return float(json.loads(Path(folder, "summary.json").read_text(encoding="utf-8"))["score"])

    first = run("one", "memory.use=true")
    assert run("two", "memory.use=true", "optimizer.evaluations=3") >= first - 1e-9
    assert run("three", "start=one", "optimizer.evaluations=3") >= first - 1e-9
    kept = yaml.safe_load(Path("three/config.yaml").read_text(encoding="utf-8"))
    assert kept["start"] == [str(tmp_path / "one")]
    assert Path("outputs/memory/simplegen.npz").is_file()
