"""The task similarities: which similarity gives the best fits, small."""

from __future__ import annotations

import json
import logging
import os
from pathlib import Path

import numpy as np
import pytest
from hydra import compose, initialize_config_dir
from hydra.core.hydra_config import HydraConfig
from omegaconf import DictConfig, OmegaConf, open_dict
from PIL import Image

from experiments import similarities
from experiments.command_check import CONFIG_FOLDER
from experiments.command_line import prepare
from experiments.errors import UserError
from experiments.settings import Variant, read_settings
from experiments.similarities_fit import JudgedFit, Search, Study, keep, kept
from experiments.similarities_page import means, page
from experiments.similarities_sheet import sheet
from experiments.similarities_targets import read_targets
from tests.conftest import blob
from treefit.image import write_mask
from treefit.similarity import Mix
from treefit.similarity.measures import agreement

SMALL = ["task=similarities", "similarities.names=[paper,treefit]", "similarities.evaluations=300", "other_seeds=1",
         "characteristics.vertices=400", "view.resolution=64"]  # fmt: skip


@pytest.fixture
def masks(tmp_path: Path) -> str:
    """Pattern of two mask files."""
    write_mask(blob(64, 64), tmp_path / "mask_round.png")
    write_mask(blob(64, 64, crown=0.2), tmp_path / "mask_narrow.png")
    return str(tmp_path / "mask_*.png")


def settings(*lines: str, folder: Path | None = None) -> DictConfig:
    """Configuration of a run, in `folder` when one is given."""
    with initialize_config_dir(str(CONFIG_FOLDER), version_base="1.3"):
        cfg = compose("config", overrides=[*SMALL, *lines], return_hydra_config=folder is not None)
    if folder is not None:
        with open_dict(cfg):
            cfg.hydra.runtime.output_dir = cfg.hydra.run.dir = str(folder)
        HydraConfig.instance().set_config(cfg)
    return cfg


def judged(picture: str, similarity: str, crown: float) -> JudgedFit:
    found = agreement(blob(256, 256), blob(256, 256, crown))
    return JudgedFit(picture, similarity, 0.5, 0.4, 2.0, found, found, blob(256, 256, crown))


def study(*fits: JudgedFit) -> Study:
    targets = {"oak": blob(256, 256), "elm": blob(256, 256)}
    return Study("simplegen 2", 300, 0, 1, {"one": Mix(), "two": Mix(combine="product")}, targets, fits)


def test_a_run_leaves_its_files_and_goes_on_where_it_was_stopped(
    tmp_path: Path, masks: str, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    out.mkdir()
    cfg = settings(f"similarities.masks={masks}", folder=out)
    similarities.run(cfg)
    told = capsys.readouterr()
    assert json.loads(told.out) == {
        "table": str(out / "similarities.md"), "sheet": str(out / "similarities.png"), "fits": 4, "failed": 0,
    }  # fmt: skip
    assert [line.partition(":")[0] for line in told.err.splitlines()] == [
        "1/4 narrow by paper", "2/4 narrow by treefit", "3/4 round by paper", "4/4 round by treefit",
    ]  # fmt: skip
    text, facts = (out / "similarities.md").read_text(encoding="utf-8"), (out / "similarities.json").read_bytes()
    assert f"'similarities.masks={tmp_path.name}/mask_*.png'" in text
    assert f"{tmp_path}" not in text
    fit = json.loads(facts)["fits"][0]
    assert (fit["picture"], fit["similarity"]) == ("narrow", "paper")
    assert set(fit["agreement"]) == set(fit["agreement_other_seeds"])

    (out / "fits" / "round" / "treefit.json").unlink()
    similarities.run(cfg)
    again = [line.rpartition(", ")[2] for line in capsys.readouterr().err.splitlines()]
    assert again[:3] == ["kept"] * 3
    assert again[3].endswith(" s")
    new = json.loads((out / "similarities.json").read_bytes())["fits"]
    assert [one | {"seconds": 0} for one in new] == [one | {"seconds": 0} for one in json.loads(facts)["fits"]]


def test_a_fit_that_fails_is_told_and_the_rest_goes_on(
    tmp_path: Path, masks: str, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def search(self: Search, mask: np.ndarray, mix: Mix) -> None:
        raise RuntimeError("no tree today")

    cfg = settings(f"similarities.masks={masks}", folder=tmp_path)
    monkeypatch.setattr(Search, "__call__", search)
    with caplog.at_level(logging.WARNING), pytest.raises(RuntimeError, match="no fit succeeded"):
        similarities.run(cfg)
    assert [record.getMessage() for record in caplog.records][-1] == "4/4 round by treefit: failed: no tree today"
    assert len(caplog.records) == 4


def test_a_kept_fit_is_the_same_and_belongs_to_its_settings(tmp_path: Path) -> None:
    keep(judged("oak", "one", 0.3), tmp_path, "these")
    found = kept(tmp_path, "oak", "one", "these")
    assert found is not None
    assert found.facts == judged("oak", "one", 0.3).facts
    assert (found.mask == blob(256, 256, 0.3)).all()
    assert kept(tmp_path, "oak", "one", "others") is None
    assert kept(tmp_path, "elm", "one", "these") is None


def test_means_are_over_pictures_that_every_similarity_has() -> None:
    some = study(judged("oak", "one", 0.3), judged("oak", "two", 0.4), judged("elm", "one", 0.1))
    found = means(some)
    assert found["two"]["silhouette_iou"] == 1
    assert found["one"]["silhouette_iou"] == judged("oak", "one", 0.3).agreement.silhouette_iou
    text = page(some, ["task=similarities"])
    assert "| oak | " in text
    assert "| elm | " in text
    assert "| **1.000** |" in text
    assert " | - |" in text


def test_the_sheet_has_a_row_a_picture_and_shows_the_targets_in_their_colours() -> None:
    one = sheet(study(judged("oak", "one", 0.3), judged("oak", "two", 0.4)))
    two = sheet(study(judged("oak", "one", 0.3), judged("oak", "two", 0.4), judged("elm", "one", 0.1)))
    assert one.shape[1] == two.shape[1]
    assert two.shape[0] > one.shape[0] + 100
    assert (one == (76, 153, 60)).all(axis=2).sum() > 10_000


def test_a_variant_leaves_out_the_terms_that_it_does_not_name() -> None:
    only = similarities.vary(Mix(), Variant(weights={"soft": 2.0}), "mine")
    assert [share for _, share in only.used] == [1.0]
    assert similarities.vary(Mix(), Variant(combine="product"), "p") == Mix(combine="product")
    assert similarities.vary(only, Variant(), "same") == only
    with pytest.raises(UserError, match=r"similarities\.variants\.odd: .*shape"):
        similarities.vary(Mix(), Variant(weights={"shape": 1.0}), "odd")


@pytest.mark.parametrize(
    ("line", "message"),
    [("similarities.names=[papr]", "did you mean 'paper'"), ("similarities.evaluations=0", "similarities.evaluations"),
     ("similarities.variants.four.weights.soft=-1", "soft")],
)  # fmt: skip
def test_wrong_settings_are_one_line(line: str, message: str) -> None:
    with pytest.raises(UserError, match=message):
        read_settings(settings(line))


def test_targets_are_named_after_their_pictures(tmp_path: Path, masks: str) -> None:
    assert list(read_targets(masks, OmegaConf.create())) == ["narrow", "round"]
    with pytest.raises(UserError, match="no file matches"):
        read_targets(str(tmp_path / "none_*.png"), OmegaConf.create())
    Image.fromarray(np.zeros((8, 8), np.uint8)).save(tmp_path / "mask_void.png")
    with pytest.raises(UserError, match=r"mask_void\.png: .*no tree"):
        read_targets(masks, OmegaConf.create())


def test_a_pattern_of_masks_is_one_value_of_hydra() -> None:
    pattern = f"similarities.masks=photos{os.sep}my masks=[1]_*.png"
    assert prepare([pattern]) == ["similarities.masks='photos/my masks=[1]_*.png'"]
