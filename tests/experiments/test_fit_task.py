"""The task fit as a user runs it: same bytes whatever the workers, and after a kill."""

from __future__ import annotations

import csv
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import yaml

from tests.experiments.program import RUN, Done, finish

SMALL = ["image=pine.png", "tracking=none", "optimizer.evaluations=1500", "optimizer.generations=10",
         "characteristics.vertices=400", "view.resolution=64", "other_seeds=2", "candidates.within=0.5",
         "asset.picture_size=64", "asset.texture_size=64", "asset.turntable=2",
         "asset.lods=[1.0,0.3]"]  # fmt: skip
FILES = ("candidates/1/preset.yaml", "candidates/3/preset.yaml", "candidates/2/mask.png", "candidates/1/tree.glb",
         "score_curve.png", "best_strip.png")  # fmt: skip


def run(folder: Path, *settings: str) -> Done:
    return finish(folder.parent, f"hydra.run.dir={folder}", *settings)


def result(folder: Path) -> list[object]:
    facts = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    del facts["seconds"], facts["evaluations_per_second"]
    lines = [json.loads(line) for line in (folder / "history.jsonl").read_text(encoding="utf-8").splitlines()]
    timeless = [{key: value for key, value in line.items() if "second" not in key} for line in lines]
    return [
        facts,
        timeless,
        (folder / "failures.jsonl").read_bytes(),
        *((folder / name).read_bytes() for name in FILES),
    ]


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("fit") / "one"
    run(folder, *SMALL, "evaluator.workers=1")
    return folder


def test_a_run_leaves_everything_that_was_promised(done: Path) -> None:
    names = {str(path.relative_to(done)) for path in done.rglob("*") if path.is_file()}
    candidate = ("tree.glb", "preset.yaml", "picture.png", "mask.png")
    assert {f"candidates/{i}/{name}" for i in (1, 2, 3) for name in candidate} < names
    assert {"summary.json", "history.jsonl", "mask.png", "mask_overlay.png", "gallery.png", "viewer.html",
            "score_curve.png", "best_strip.png", "candidates.csv", "checkpoint.npz", "config.yaml"} < names  # fmt: skip
    facts = json.loads((done / "summary.json").read_text(encoding="utf-8"))
    assert facts["evaluations"] == 1500
    assert facts["score"] == max(found["score"] for found in facts["candidates"])
    assert {"score_other_seeds", "silhouette_iou", "silhouette_iou_other_seeds", "texture", "vertices", "leaves",
            "triangles", "height_m", "width_m", "values"} <= set(facts["candidates"][0])  # fmt: skip


def test_the_table_of_candidates_says_what_the_summary_says(done: Path) -> None:
    facts = json.loads((done / "summary.json").read_text(encoding="utf-8"))["candidates"]
    with (done / "candidates.csv").open(encoding="utf-8", newline="") as file:
        rows = [*csv.DictReader(file)]
    assert [row.pop("candidate") for row in rows] == ["1", "2", "3"]
    assert [{name: float(value) for name, value in row.items()} for row in rows] == [
        {name: fact for name, fact in found.items() if isinstance(fact, int | float) and name not in ("seed", "seeds")}
        | {f"{fact}_{level['name'].removeprefix('tree_')}": level[fact]
           for level in found["levels"][1:] for fact in ("triangles", "silhouette_iou")}
        for found in facts
    ]  # fmt: skip


def test_the_summary_names_the_levels_and_files_of_every_candidate(done: Path) -> None:
    for number, found in enumerate(json.loads((done / "summary.json").read_text(encoding="utf-8"))["candidates"], 1):
        assert {level["file"] for level in found["levels"]} <= set(found["files"])
        assert found["levels"][0]["triangles"] == found["triangles"]
        assert all((done / "candidates" / str(number) / name).is_file() for name in found["files"])


def test_the_same_seed_gives_the_same_bytes_on_two_workers(done: Path) -> None:
    other = done.parent / "two"
    run(other, *SMALL, "evaluator.workers=2")
    assert result(other) == result(done)


@pytest.mark.slow
def test_a_killed_run_goes_on_to_the_same_bytes(done: Path) -> None:
    folder = done.parent / "killed"
    command = [sys.executable, str(RUN), f"hydra.run.dir={folder}", *SMALL, "live=true"]
    with subprocess.Popen(command, cwd=done.parent, start_new_session=True, stderr=subprocess.DEVNULL) as child:
        log, deadline = folder / "history.jsonl", time.monotonic() + 100
        while not (log.exists() and log.read_bytes().count(b"\n") >= 8):
            assert child.poll() is None, "the run ended before it could be killed"
            assert time.monotonic() < deadline
            time.sleep(0.005)
        os.killpg(child.pid, signal.SIGKILL)
    assert not (folder / "summary.json").exists()
    assert '"running": true' in (folder / "live.html").read_text(encoding="utf-8")
    finish(done.parent, f"resume={folder}")
    assert result(folder) == result(done)
    assert '"running": false' in (folder / "live.html").read_text(encoding="utf-8")
    assert not (done / "live.html").exists()


def test_grow_takes_the_preset_back_and_makes_the_same_tree(done: Path) -> None:
    folder = done.parent / "grown"
    preset = done / "candidates" / "1" / "preset.yaml"
    fitted = json.loads((done / "summary.json").read_text(encoding="utf-8"))
    kept = fitted["candidates"][0]
    told = run(folder, "task=grow", f"preset={preset}", "asset.texture_size=64", "asset.turntable=0")
    facts = json.loads(told.stdout.splitlines()[-1])
    assert (facts["vertices"], facts["leaves"], facts["height_m"]) == (
        kept["vertices"],
        kept["leaves"],
        kept["height_m"],
    )
    assert (folder / "tree.glb").read_bytes() == (done / "candidates" / "1" / "tree.glb").read_bytes()
    again = yaml.safe_load((folder / "preset.yaml").read_text(encoding="utf-8"))
    assert again["values"] == yaml.safe_load(preset.read_text(encoding="utf-8"))["values"]
