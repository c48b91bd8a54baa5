from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from pydantic import ValidationError

from treefit.image.file import FileMask
from treefit.image.picture import Picture
from treefit.image.read import PictureError, read_mask_file, write_mask
from treefit.mask import BRANCH, FOLIAGE, PALETTE, Mask


def small_tree(height: int = 200, width: int = 100) -> Mask:
    mask = np.zeros((height, width), np.uint8)
    mask[height // 10 : height // 2, width // 5 : -width // 5] = FOLIAGE
    mask[height // 2 : -height // 10, 2 * width // 5 : -2 * width // 5] = BRANCH
    return mask


def white(height: int, width: int) -> Picture:
    return Picture(np.full((height, width, 3), 255, np.uint8))


def test_a_written_mask_is_read_back_and_is_a_palette_png(tmp_path: Path) -> None:
    mask = small_tree()
    write_mask(mask, tmp_path / "mask.png")
    assert np.array_equal(read_mask_file(tmp_path / "mask.png"), mask)
    with Image.open(tmp_path / "mask.png") as image:
        assert (image.format, image.mode, image.size) == ("PNG", "P", (100, 200))
        assert image.convert("RGB").getpixel((50, 50)) == PALETTE[FOLIAGE]


def test_writing_twice_gives_the_same_bytes(tmp_path: Path) -> None:
    write_mask(small_tree(), tmp_path / "a.png")
    write_mask(small_tree(), tmp_path / "b.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_grey_values_0_1_2_are_a_mask(tmp_path: Path) -> None:
    Image.fromarray(small_tree()).save(tmp_path / "grey.png")
    assert np.array_equal(read_mask_file(tmp_path / "grey.png"), small_tree())


def test_other_values_are_named_with_what_is_meant(tmp_path: Path) -> None:
    Image.fromarray(small_tree() * 127).save(tmp_path / "grey.png")
    with pytest.raises(PictureError, match=r"grey\.png.*0 background, 1 branch, 2 foliage; got 0, 127, 254"):
        read_mask_file(tmp_path / "grey.png")


@pytest.mark.parametrize("mode", ["RGB", "RGBA", "P"])
def test_a_mask_saved_by_a_paint_program_in_the_palettes_colours_is_read(tmp_path: Path, mode: str) -> None:
    write_mask(small_tree(), tmp_path / "mask.png")
    with Image.open(tmp_path / "mask.png") as image:
        colours = image.convert("RGB")
    (colours.quantize(5) if mode == "P" else colours.convert(mode)).save(tmp_path / "painted.png")
    assert np.array_equal(read_mask_file(tmp_path / "painted.png"), small_tree())


def test_soft_brushes_nearly_right_colours_and_clear_ground_are_understood(tmp_path: Path) -> None:
    pixels = np.zeros((200, 100, 4), np.uint8)
    pixels[small_tree() == FOLIAGE] = (70, 170, 50, 255)
    pixels[small_tree() == BRANCH] = (130, 80, 70, 255)
    image = Image.fromarray(pixels).resize((400, 800)).resize((100, 200))
    image.save(tmp_path / "painted.png")
    assert (read_mask_file(tmp_path / "painted.png") == small_tree()).mean() > 0.99


@pytest.mark.parametrize("colour", ["black", "green", "orange"])
def test_a_picture_of_other_colours_is_no_mask_file(tmp_path: Path, colour: str) -> None:
    Image.new("RGB", (20, 20), colour).save(tmp_path / "colour.png")
    with pytest.raises(
        PictureError, match=r"0 background, 1 branch, 2 foliage, or the colours .* \(76, 153, 60\)"
    ) as caught:
        read_mask_file(tmp_path / "colour.png")
    assert "mode RGB and other colours" in str(caught.value)


def test_a_mask_of_another_scale_is_resized_without_new_classes(tmp_path: Path) -> None:
    write_mask(small_tree(), tmp_path / "mask.png")
    found = FileMask(tmp_path / "mask.png")(white(400, 200))
    assert found.method == "file"
    assert found.confidence == 1.0
    assert np.array_equal(found.mask, small_tree().repeat(2, axis=0).repeat(2, axis=1))


def test_a_mask_of_another_shape_is_refused(tmp_path: Path) -> None:
    write_mask(small_tree(), tmp_path / "mask.png")
    with pytest.raises(PictureError, match="100 x 200 pixels and the picture 200 x 200"):
        FileMask(tmp_path / "mask.png")(white(200, 200))


def test_an_empty_mask_is_refused(tmp_path: Path) -> None:
    write_mask(np.zeros((50, 50), np.uint8), tmp_path / "mask.png")
    with pytest.raises(PictureError, match="no tree was found"):
        FileMask(tmp_path / "mask.png")(white(50, 50))


def test_unknown_settings_are_refused() -> None:
    with pytest.raises(ValidationError, match=r"(?i)unexpected"):
        FileMask(path="mask.png", threshold=3)  # type: ignore[call-arg]
