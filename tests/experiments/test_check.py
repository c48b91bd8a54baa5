"""Task check, as it is started: what is printed and written, and the exit status."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import NamedTuple

import pytest
from omegaconf import OmegaConf

from experiments import check, command_check
from experiments.check_settings import Check
from experiments.errors import UserError
from tests.experiments.program import finish, run_program
from tests.plant.contract.changes import lifted, mixed_units, plants
from tests.plant.contract.sticks import Sticks
from treefit.plant import Budget, Generator, Plant, read_preset
from treefit.plant.contract import RULES, name_of


class Told(NamedTuple):
    """What the task printed, and the error that it ended with, "" for none."""

    stdout: str
    error: str


@pytest.fixture
def told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Callable[..., Told]:
    """The task alone: what it says of a generator."""

    def run(generator: Generator) -> Told:
        settings = SimpleNamespace(seed=0, check=Check(plants=20))
        for name, value in {"build": generator, "read_settings": settings, "run_folder": tmp_path}.items():
            monkeypatch.setattr(check, name, lambda *_, value=value: value)
        error = ""
        try:
            check.run(OmegaConf.create({"generator": {}}))
        except check.ContractBroken as broken:
            error = str(broken)
        return Told(capsys.readouterr().out, error)

    return run


def test_a_generator_of_ours_keeps_all_rules_and_ends_well(tmp_path: Path) -> None:
    done = finish(tmp_path, "task=check", "generator=simplegen", "check.plants=10", "hydra.run.dir=out")
    assert f"{len(RULES)} of {len(RULES)} rules hold\n" in done.stdout
    assert "10 of 10" in done.stdout
    told = json.loads((tmp_path / "out" / "check.json").read_text(encoding="utf-8"))
    assert (told["generator"], told["plants"]) == ("simplegen", 10)
    assert [rule["rule"] for rule in told["rules"]] == [name_of(rule) for rule in RULES]
    assert {rule["verdict"] for rule in told["rules"]} == {"ok"}
    assert {file.name for file in (tmp_path / "out").iterdir()} - {"run.log"} == {"check.json", "config.yaml"}


def test_a_rule_that_must_hold_ends_with_status_1_and_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    generator = plants(lambda plant: lifted(plant, (1.0, 0, 0)))
    monkeypatch.setattr(check, "build", lambda *_: generator)
    done = run_program(tmp_path, "task=check", "check.plants=20", "hydra.run.dir=out")
    assert done.status == 1
    assert len(done.stderr.splitlines()) == 1
    assert done.stderr.startswith("error: sticks breaks a rule: the root stands at the origin (details: ")
    line = next(line for line in done.stdout.splitlines() if line.startswith("FAILED"))
    assert "the root stands at the origin" in line
    assert "20 of 20 plants: the root is at" in line
    assert f"{len(RULES) - 1} of {len(RULES)} rules hold, 1 failed" in done.stdout
    preset = read_preset(tmp_path / "out" / "the_root_stands_at_the_origin.yaml")
    assert generator(dict(preset.values), preset.seed, Budget()).position[0, 0] > 0


def test_warnings_alone_end_well(told: Callable[..., Told]) -> None:
    stdout, error = told(Sticks(mixed_units))
    assert error == ""
    assert f"{len(RULES) - 1} of {len(RULES)} rules hold, 1 warning\n" in stdout
    assert "look     python run.py task=grow preset=" in stdout


def test_a_generator_that_only_fails_is_a_failure_and_no_crash(told: Callable[..., Told]) -> None:
    def fail(*_: object) -> Plant:
        raise OSError("no bark")

    stdout, error = told(Sticks(fail))
    assert error == "sticks breaks a rule: random genomes give valid plants"
    assert "10 of 10 give none, the first: OSError: no bark" in stdout
    assert "there is no plant" in stdout
    assert "50,000" not in stdout


@pytest.mark.parametrize(("setting", "words"), [
    ("check.plants=2", "check.plants: must be greater than or equal to 5, got 2"),
    ("check.plnts=20", "check.plnts: no such setting; did you mean 'plants'?"),
])  # fmt: skip
def test_wrong_settings_are_one_line(setting: str, words: str) -> None:
    with pytest.raises(UserError) as caught:
        command_check.check(["task=check", setting], sweep=False)
    assert words in str(caught.value)
