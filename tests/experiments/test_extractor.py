import re
from pathlib import Path

import pytest
from hydra import compose, initialize_config_dir
from omegaconf import DictConfig

from experiments.command_check import CONFIG_FOLDER
from experiments.errors import UserError
from experiments.extractor import build_extractor
from treefit.image import ColourMask, FileMask, Help, HelpedMask


def mask_group(*settings: str) -> DictConfig:
    with initialize_config_dir(str(CONFIG_FOLDER), version_base="1.3"):
        return compose("config", overrides=list(settings)).mask


@pytest.mark.parametrize("option", ["auto", "alpha", "sketch", "colour"])
def test_every_extractor_takes_help_and_is_itself_without(option: str) -> None:
    plain = build_extractor(mask_group(f"mask={option}"), "mask")
    assert not isinstance(plain, HelpedMask)
    helped = build_extractor(mask_group(f"mask={option}", "mask.point=[0.5,0.5]", "mask.crop=[0,0,99,98]"), "mask")
    assert helped == HelpedMask(plain, Help(point=(0.5, 0.5), crop=(0, 0, 99, 98)))


def test_settings_of_the_extractor_stay_beside_the_help() -> None:
    outline = "mask.outline=[[1,2],[30,4],[5,60]]"
    found = build_extractor(mask_group("mask=colour", "mask.size=300", outline), "mask")
    assert found == HelpedMask(ColourMask(size=300), Help(outline=((1, 2), (30, 4), (5, 60))))


def test_a_mask_file_takes_no_help() -> None:
    assert build_extractor(mask_group("mask=file", "mask.path=m.png"), "mask") == FileMask(Path("m.png"))
    with pytest.raises(UserError, match=r"^mask\.point: the file of mask=file is taken as it is; correct it"):
        build_extractor(mask_group("mask=file", "mask.path=m.png", "mask.point=[1,2]"), "mask")


@pytest.mark.parametrize(
    ("setting", "line"),
    [
        ("mask.outline=[[1,2],[3,4]]", "mask.outline: must have at least 3 different points [x, y], got 2"),
        ("mask.point=7", "mask.point: must be [x, y], all of them numbers; got 7"),
        ("mask.crop=[5,5,4,9]", "mask.crop: must be [left, top, right, bottom], left under right"),
    ],
)
def test_wrong_help_is_one_line(setting: str, line: str) -> None:
    with pytest.raises(UserError, match=f"^{re.escape(line)}") as caught:
        build_extractor(mask_group(setting), "mask")
    assert "\n" not in str(caught.value)
