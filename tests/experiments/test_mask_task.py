import shlex
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from experiments.mask import CORNERS, rough_outline, what_next
from experiments.read_tree import ReadTree
from treefit.image import ColourMask, FileMask, Help, HelpedMask, Picture, read_picture, write_mask
from treefit.image.extraction import Extraction
from treefit.mask import BRANCH, FOLIAGE, Mask

OAK = Path(__file__).parents[2] / "experiments" / "images" / "oak.png"


def tree(mask: Mask) -> ReadTree:
    return ReadTree("photo.jpg", Picture(np.zeros((*mask.shape, 3), np.uint8)), Extraction(mask, "colour", 1.0, "so"))


def round_tree() -> Mask:
    rows, columns = np.mgrid[:400, :300]
    return np.where(np.hypot(rows - 180, columns - 150) < 100, FOLIAGE, 0).astype(np.uint8)


def test_the_rough_outline_goes_around_the_tree_and_can_be_given_back() -> None:
    corners = rough_outline(round_tree())
    assert 3 <= len(corners) <= CORNERS
    polygon = Help(outline=tuple(corners)).polygon((400, 300))
    assert polygon is not None
    np.testing.assert_allclose(np.hypot(*(polygon - (150, 180)).T), 100, atol=6)


def test_what_to_do_next_is_two_commands_with_the_pictures_own_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    lines = what_next(tree(round_tree()), tmp_path / "my photo.jpg", tmp_path / "out")
    commands = [shlex.split(line[line.index("python run.py") :]) for line in lines]
    assert commands[0][2:4] == ["task=mask", "image=my photo.jpg"]
    assert commands[0][4].startswith("mask.outline=[[")
    assert commands[1][2:] == ["image=my photo.jpg", "mask=file", "mask.path=out/mask.png"]


def test_a_mask_is_corrected_in_a_paint_program_and_given_back(tmp_path: Path) -> None:
    picture = read_picture(OAK)
    first = ColourMask()(picture).mask
    write_mask(first, tmp_path / "mask.png")
    with Image.open(tmp_path / "mask.png") as image:
        painted = image.convert("RGB")
    painted.paste((121, 85, 61), (0, 0, 40, 30))
    painted.save(tmp_path / "corrected.png")
    expected = first.copy()
    expected[:30, :40] = BRANCH
    assert np.array_equal(FileMask(tmp_path / "corrected.png")(picture).mask, expected)


@pytest.mark.slow
def test_the_outline_that_is_proposed_finds_the_same_tree() -> None:
    picture = read_picture(OAK)
    first = ColourMask()(picture).mask
    again = HelpedMask(ColourMask(), Help(outline=tuple(rough_outline(first))))(picture).mask
    assert ((first > 0) & (again > 0)).sum() / ((first > 0) | (again > 0)).sum() > 0.85
