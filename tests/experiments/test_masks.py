"""The task masks: what it measures, and that no picture ends it for the others."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hydra import compose, initialize_config_dir
from hydra.core.hydra_config import HydraConfig
from omegaconf import open_dict
from PIL import Image

from experiments import masks
from experiments.command_check import CONFIG_FOLDER
from experiments.masks_measure import Found, agreement, iou
from experiments.masks_page import means, page
from experiments.masks_sheet import sheet
from treefit.image import Extraction, Picture
from treefit.image.read import PictureError, write_mask
from treefit.mask import BRANCH, FOLIAGE, Mask


def drawn() -> Mask:
    mask = np.zeros((40, 40), np.uint8)
    mask[5:25, 10:30], mask[25:38, 18:22] = FOLIAGE, BRANCH
    return mask


def picture() -> Picture:
    return Picture(np.where(drawn()[..., None] > 0, np.uint8(60), np.uint8(250)).repeat(3, axis=2))


def test_a_mask_agrees_with_itself_and_a_shifted_one_as_much_as_they_share() -> None:
    mask = drawn()
    assert agreement(mask, mask) == {"tree": 1.0, "classes": 1.0, "branch": 1.0}
    told = agreement(np.roll(mask, 2, axis=1), mask)
    crown, trunk = (18 * 20, 22 * 20), (2 * 13, 6 * 13)  # shared and together, pixels
    assert told["tree"] == pytest.approx((crown[0] + trunk[0]) / (crown[1] + trunk[1]))
    assert told["branch"] == pytest.approx(trunk[0] / trunk[1])


def test_a_class_that_neither_has_does_not_count() -> None:
    leaves = np.where(drawn() == BRANCH, 0, drawn()).astype(np.uint8)
    told = agreement(leaves, leaves)
    assert told["classes"] == 1.0
    assert np.isnan(told["branch"])
    assert np.isnan(iou(np.zeros((2, 2), bool), np.zeros((2, 2), bool)))


def test_a_picture_without_a_tree_is_told_and_does_not_end_the_others() -> None:
    def find(one: Picture) -> Extraction:
        if one.shape != (40, 40):
            raise PictureError("no tree\nwas found")
        return Extraction(drawn(), "colour", 0.8, "because")

    empty = Picture(np.zeros((30, 20, 3), np.uint8))
    found = [Found.of("oak", picture(), "colour", find, drawn()), Found.of("wall", empty, "colour", find, None)]
    assert (found[1].error, found[1].agreement) == ("no tree was found", None)
    assert means("colour", found)["tree"] == 1.0
    text = page(found, ["task=masks"])
    assert "| oak | 1.00 / 1.00 / 1.00 |" in text
    assert "no tree was found" in text
    shown = sheet({"oak": picture(), "wall": empty}, found)
    assert shown.ndim == 3
    assert (shown != 255).any()


def test_a_picture_without_a_mask_counts_nothing_when_there_should_be_one() -> None:
    def fail(_: Picture) -> Extraction:
        raise PictureError("no tree")

    found = [Found.of("oak", picture(), "colour", fail, drawn())]
    assert found[0].agreement == {"tree": 0.0, "classes": 0.0, "branch": 0.0}
    assert means("colour", found)["least"] == 0.0


def test_the_task_reads_all_pictures_and_writes_table_and_sheet(tmp_path: Path) -> None:
    Image.fromarray(picture().rgb).save(tmp_path / "oak.png")
    write_mask(drawn(), tmp_path / "mask_oak.png")
    lines = ["task=masks", f"masks.pictures={tmp_path}/*.png", f"masks.references={tmp_path}/mask_*.png",
             "masks.methods=[colour,auto]"]  # fmt: skip
    with initialize_config_dir(str(CONFIG_FOLDER), version_base="1.3"):
        cfg = compose("config", overrides=lines, return_hydra_config=True)
        with open_dict(cfg):
            cfg.hydra.runtime.output_dir = str(tmp_path)
        HydraConfig.instance().set_config(cfg)
        masks.run(cfg)
    facts = json.loads((tmp_path / "masks.json").read_text(encoding="utf-8"))
    assert set(facts) == {"colour", "auto"}
    assert facts["colour"]["pictures"] == 1
    assert facts["colour"]["tree"] > 0.9
