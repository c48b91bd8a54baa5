import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

from experiments import entry
from tests.experiments.program import RUN, Done, finish, run_program
from treefit.regrowth import GoneError, SearchError


@pytest.fixture
def here(tmp_path: Path) -> Path:
    image = Image.new("RGB", (200, 260), (214, 232, 250))
    draw = ImageDraw.Draw(image)
    draw.rectangle((92, 150, 108, 255), fill=(110, 75, 50))
    draw.ellipse((40, 20, 160, 180), fill=(50, 120, 40))
    image.save(tmp_path / "été, [a=1] (2).png")
    (tmp_path / "text.png").write_text("no picture")
    return tmp_path


def start(here: Path, *arguments: str) -> Done:
    """The program as a process of its own."""
    command, place = [sys.executable, str(RUN), *arguments], {**os.environ, "PYTHONUTF8": "1"}
    done = subprocess.run(command, cwd=here, capture_output=True, text=True, timeout=120, env=place)
    return Done(done.returncode, done.stdout, done.stderr)


def test_mask_of_a_picture_with_a_difficult_name(here: Path) -> None:
    done = start(here, "task=mask", "image=été, [a=1] (2).png", "hydra.run.dir=my out")
    assert done.status == 0, done.stderr
    told = json.loads(done.stdout.splitlines()[-1])
    assert set(told) == {"method", "confidence", "warnings", "tree_fraction"}
    with Image.open(here / "my out" / "mask.png") as mask:
        assert mask.mode == "P"
        assert mask.size == (200, 260)
        pixels = np.asarray(mask)
    assert set(np.unique(pixels)) <= {0, 1, 2}
    assert np.isclose((pixels > 0).mean(), told["tree_fraction"])
    written = {file.name for file in (here / "my out").iterdir()}
    assert written - {"run.log"} == {"mask.png", "mask_overlay.png", "config.yaml"}


@pytest.mark.parametrize(("run", "setting"), [(run_program, "task=mask"), (start, "optimizer.evaluations=-5")])
def test_wrong_input_is_one_line_and_leaves_nothing(
    here: Path, run: Callable[[Path, str, str], Done], setting: str
) -> None:
    before = sorted(here.iterdir())
    done = run(here, "image=text.png", setting)
    assert done.status == 2
    assert done.stdout == ""
    assert len(done.stderr.splitlines()) == 1
    assert done.stderr.startswith("error: ")
    assert sorted(here.iterdir()) == before


def test_sweep_goes_on_after_a_failure_and_its_status_tells(here: Path) -> None:
    done = run_program(here, "-m", "task=mask", "image=*.png", "hydra.sweep.dir=out")
    assert done.status == 1
    assert "Traceback" not in done.stderr
    assert done.stderr.count("error: ") == 1
    assert "1 of 2 runs done, 1 failed" in done.stdout
    jobs = {json.loads(file.read_text())["status"] for file in (here / "out").glob("*/job.json")}
    assert jobs == {"failed", "done"}
    assert (here / "out" / "sweep.html").is_file()
    assert (here / "out" / "sweep.png").is_file()


def test_help_names_every_group_and_task(here: Path) -> None:
    done = finish(here, "--help")
    for word in ("python run.py image=pine.png", "benchmark", "simplegen", "tree_ga", "mlflow", "outputs/"):
        assert word in done.stdout


@pytest.mark.parametrize(("kept", "words"), [
    ("checkpoint.npz", "; to go on: python run.py resume="), ("pairs_0000.npz", "; to go on: python run.py resume="),
    ("runs/simplegen", "; to go on: the same command with hydra.run.dir="), ("run.log", ""),
])  # fmt: skip
def test_a_stopped_run_says_how_to_go_on_when_something_is_kept(tmp_path: Path, kept: str, words: str) -> None:
    (tmp_path / kept).mkdir(parents=True)
    assert entry.how_to_go_on(tmp_path) == (words and f"{words}{tmp_path}")


def test_a_run_whose_generator_is_gone_says_how_to_go_on(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "checkpoint.npz").touch()
    assert (
        entry._tell(GoneError("no\nmore"), False, tmp_path, True)
        == entry._tell(SearchError("no"), False, tmp_path, True)
        == 1
    )
    details = f" (details: {tmp_path / 'run.log'})"
    assert caplog.messages == [f"no more; to go on: python run.py resume={tmp_path}{details}", f"no{details}"]
