"""The task statistics, small: its targets, what it counts and writes, and how a killed run goes on."""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hydra import compose, initialize_config_dir
from hydra.core.hydra_config import HydraConfig
from omegaconf import DictConfig, open_dict

from experiments import statistics, statistics_collect, statistics_plots
from experiments.command_check import CONFIG_FOLDER
from experiments.drawn_crowns import COLUMNS, HABITS, ROWS, drawn_crown
from experiments.errors import UserError
from experiments.settings import read_settings
from experiments.statistics_targets import DRAWN, PLANTS, picture, targets
from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from tests.family.counted import Counted
from treefit.family.batch import grow_batch
from treefit.family.identity import FamilyError, fingerprint
from treefit.family.statistics import Statistics, find_statistics
from treefit.mask import BRANCH, FOLIAGE
from treefit.placing import place
from treefit.similarity import Mix, PaperSimilarity

SMALL = ["task=statistics", "statistics.targets=4", "statistics.plants=50", "statistics.fresh=20", "statistics.steps=3",
         "view.resolution=64", "evaluator.workers=2"]  # fmt: skip


TARGETS = cache(targets)


@pytest.fixture(autouse=True)
def _small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(statistics_collect, "PLANTS", 20)
    monkeypatch.setattr(statistics, "targets", TARGETS)
    for name in ("draw_rate", "draw_marks", "draw_calibration"):  # one test draws them
        monkeypatch.setattr(statistics, name, lambda *told: told[-1].touch())


def settings(folder: Path, *lines: str) -> DictConfig:
    with initialize_config_dir(str(CONFIG_FOLDER), version_base="1.3"):
        cfg = compose("config", overrides=[*SMALL, *lines], return_hydra_config=True)
    folder.mkdir(exist_ok=True)
    with open_dict(cfg):
        cfg.hydra.runtime.output_dir = cfg.hydra.run.dir = str(folder)
    HydraConfig.instance().set_config(cfg)
    return cfg


@pytest.mark.parametrize("name", HABITS)
def test_a_drawn_crown_is_a_whole_tree_on_its_trunk_and_the_same_again(name: str) -> None:
    mask = drawn_crown(name, 5)
    assert (mask == drawn_crown(name, 5)).all()
    assert (mask != drawn_crown(name, 6)).any()
    at = place(mask)
    assert at.bottom == ROWS
    assert at.top < 0.3 * ROWS
    assert at.base == pytest.approx(COLUMNS / 2, abs=0.06 * ROWS)
    assert 0.08 < at.reach < 1.0
    assert (mask == BRANCH).any()
    assert (mask == FOLIAGE).any() == (name != "bare")


def test_targets_are_plants_of_all_generators_and_a_third_is_drawn() -> None:
    found = targets(9, 1)
    kinds = [target.name.split()[0] for target in found]
    assert kinds == ["simplegen", "weberpenn", "gegen"] * 2 + ["drawn"] * 3
    assert all(PLANTS[0] <= target.vertices <= PLANTS[1] for target in found[:6])
    assert all(DRAWN[0] <= target.vertices <= DRAWN[1] for target in found[6:])
    assert len({target.mask.tobytes() for target in found}) == 9
    again = targets(9, 1)
    assert all(
        (one.mask == two.mask).all() and one.vertices == two.vertices for one, two in zip(found, again, strict=True)
    )
    assert picture(found, 3).shape == (3 * (ROWS // 2 + 8), 3 * (ROWS + 8))


def test_the_task_writes_statistics_plots_and_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("draw_rate", "draw_marks", "draw_calibration"):
        monkeypatch.setattr(statistics, name, getattr(statistics_plots, name))
    statistics.run(settings(tmp_path))
    told = json.loads(capsys.readouterr().out.splitlines()[-1])
    found = Statistics.read(tmp_path / "statistics.npz")
    assert told["evaluations"] == found.evaluations == 4 * 50
    assert told["p0"] == found.p0
    assert all(Path(file).stat().st_size > 0 for file in told["files"])
    assert len(told["files"]) == 4
    assert len(told["liveliest"]) == 5
    assert set(told["calibration"]) == {"continuous", "paper"}
    assert found.names == SimpleGen().space.names
    assert found.similarity == fingerprint(Mix())
    assert (found.steps == 3).all()
    assert found.eps.shape == (4,)


def test_a_killed_run_goes_on_and_ends_with_the_same_bytes_on_any_number_of_workers(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    statistics.run(settings(tmp_path / "whole"))
    statistics.run(settings(tmp_path / "part", "evaluator.kind=serial"))
    for lost in ("pairs_0001.npz", "moved_000.npz", "statistics.npz"):
        (tmp_path / "part" / lost).unlink()
    (tmp_path / "part" / "pairs_0002.npz.tmp").write_bytes(b"half")
    grown = []
    monkeypatch.setattr(statistics_collect, "grow_batch", lambda *told: grown.append(told) or grow_batch(*told))
    statistics.run(settings(tmp_path / "part"))
    assert [told[2] for told in grown] == [(0, 0, 1)]
    for name in ("statistics.npz", "guess.npz", "pairs_0001.npz", "pairs_fresh_0000.npz", "moved_000.npz"):
        one, two = (np.load(tmp_path / folder / name) for folder in ("whole", "part"))
        assert all(one[key].tobytes() == two[key].tobytes() for key in one.files)


def test_more_plants_go_on_from_those_that_there_are(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    statistics.run(settings(tmp_path))
    grown = []
    monkeypatch.setattr(statistics_collect, "grow_batch", lambda *told: grown.append(told) or grow_batch(*told))
    statistics.run(settings(tmp_path, "statistics.plants=70"))
    assert sorted(told[1:] for told in grown) == [(10, (0, 0, 3)), (20, (0, 0, 2))]


def test_a_folder_of_another_collection_is_refused_in_one_line(tmp_path: Path) -> None:
    statistics.run(settings(tmp_path))
    with pytest.raises(FamilyError, match=r"pairs_0\d+.npz: is of another collection .*; delete it"):
        statistics.run(settings(tmp_path, "similarity=paper"))


def test_renewed_statistics_are_found_by_a_search_with_their_similarity(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(SimpleGen, "family", tmp_path / "family")
    monkeypatch.setattr(statistics, "FIGURES", tmp_path)
    for number, line in enumerate(("similarity=treefit", "similarity=paper", "similarity.combine=product")):
        statistics.run(settings(tmp_path / str(number), line, "statistics.renew=true"))
    names = sorted(path.name for path in (tmp_path / "family").iterdir())
    assert [name for name in names if not re.fullmatch(r"statistics_[0-9a-f]{16}\.npz", name)] == [
        "guess.npz", "statistics.npz", "statistics_paper.npz",
    ]  # fmt: skip
    assert len(names) == 4
    assert (tmp_path / "statistics_simplegen_marks.png").is_file()
    for similarity in (Mix(), PaperSimilarity(), Mix(combine="product")):
        found = find_statistics(SimpleGen(), similarity)
        assert found is not None
        assert found.similarity == fingerprint(similarity)


def test_a_resumed_run_renews_the_files_of_its_own_generator(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(WeberPennGen, "family", tmp_path / "family")
    monkeypatch.setattr(statistics, "FIGURES", tmp_path)
    cfg = settings(tmp_path, "generator=weberpenn", "statistics.renew=true")
    settings(tmp_path)  # the command line of resume= names no generator
    statistics.run(cfg)
    assert sorted(path.name for path in (tmp_path / "family").iterdir()) == ["guess.npz", "statistics.npz"]


def test_other_parameters_than_those_of_an_option_have_files_of_their_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(SimpleGen, "family", tmp_path / "family")
    monkeypatch.setattr(statistics, "FIGURES", tmp_path)
    for number, line in enumerate(("generator=simplegen_paper", "++generator.fixed.wobble=0.1")):
        statistics.run(settings(tmp_path / str(number), line, "statistics.renew=true"))
    names = sorted(path.name for path in (tmp_path / "family").iterdir())
    assert [re.sub(r"[0-9a-f]{16}", "hash", name) for name in names] == [
        "guess_hash.npz", "guess_simplegen_paper.npz", "statistics_hash.npz", "statistics_simplegen_paper.npz",
    ]  # fmt: skip


def test_a_generator_without_a_folder_cannot_renew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(statistics, "build", lambda node, place: Counted())
    with pytest.raises(UserError, match="generator 'simplegen' has no folder for statistics"):
        statistics.run(settings(tmp_path, "statistics.renew=true"))


@pytest.mark.parametrize(
    "line", ["statistics.share=0", "statistics.eps=2", "statistics.targets=2", "statistics.plants=many"]
)
def test_settings_out_of_range_are_one_line(tmp_path: Path, line: str) -> None:
    with pytest.raises(UserError, match=rf"^{line.partition('=')[0]}: must be"):
        read_settings(settings(tmp_path, line))
