import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from treefit.image.read import PictureError, read_picture

RED, BLUE = (220, 30, 20), (20, 40, 210)


def two_halves(width: int = 40, height: int = 20) -> Image.Image:
    """Red on the left, blue on the right."""
    image = Image.new("RGB", (width, height), RED)
    image.paste(BLUE, (width // 2, 0, width, height))
    return image


def close(pixel: np.ndarray, colour: tuple[int, ...], tolerance: int = 40) -> bool:
    return bool(np.abs(pixel.astype(int) - colour).max() <= tolerance)


@pytest.mark.parametrize(("turn", "shape", "top_left"), [(3, (20, 40), BLUE), (6, (40, 20), RED), (8, (40, 20), BLUE)])
def test_a_jpeg_is_turned_as_its_exif_says(tmp_path: Path, turn: int, shape: tuple[int, int], top_left: tuple) -> None:
    exif = Image.Exif()
    exif[0x0112] = turn
    two_halves().save(tmp_path / "turned.jpg", exif=exif, quality=95)
    picture = read_picture(tmp_path / "turned.jpg")
    assert picture.shape == shape
    assert close(picture.rgb[2, 2], top_left)
    assert picture.alpha is None


def test_a_cmyk_jpeg_keeps_its_colours(tmp_path: Path) -> None:
    two_halves().convert("CMYK").save(tmp_path / "print.jpg", quality=95)
    picture = read_picture(tmp_path / "print.jpg")
    assert close(picture.rgb[10, 5], RED)
    assert close(picture.rgb[10, 35], BLUE)


def test_sixteen_bit_grey_is_scaled_and_not_clipped(tmp_path: Path) -> None:
    values = np.linspace(0, 65535, 64 * 16).reshape(16, 64).astype(np.uint16)
    Image.fromarray(values).save(tmp_path / "deep.png")
    rgb = read_picture(tmp_path / "deep.png").rgb
    assert np.array_equal(rgb[..., 0], np.round(values / 257).astype(np.uint8))
    assert np.array_equal(rgb[..., 0], rgb[..., 2])


def test_floating_point_grey_of_0_to_1_fills_the_range(tmp_path: Path) -> None:
    Image.fromarray(np.linspace(0, 1, 64, dtype=np.float32).reshape(8, 8)).save(tmp_path / "float.tiff")
    rgb = read_picture(tmp_path / "float.tiff").rgb
    assert (rgb.min(), rgb.max()) == (0, 255)


def test_a_palette_with_transparency_becomes_white_and_alpha(tmp_path: Path) -> None:
    image = two_halves().quantize(4)
    image.save(tmp_path / "palette.png", transparency=image.getpixel((0, 0)))
    picture = read_picture(tmp_path / "palette.png")
    assert picture.alpha is not None
    assert picture.alpha[0, 0] == 0
    assert picture.alpha[0, 39] == 255
    assert tuple(picture.rgb[0, 0]) == (255, 255, 255)
    assert close(picture.rgb[0, 39], BLUE)


def test_grey_with_alpha_is_laid_on_white(tmp_path: Path) -> None:
    image = Image.new("LA", (10, 10), (0, 128))
    image.save(tmp_path / "la.png")
    picture = read_picture(tmp_path / "la.png")
    assert picture.alpha is not None
    assert (picture.alpha == 128).all()
    assert close(picture.rgb[0, 0], (127, 127, 127), 1)


def test_colours_hidden_under_alpha_zero_are_not_seen(tmp_path: Path) -> None:
    Image.new("RGBA", (10, 10), (*RED, 0)).save(tmp_path / "hidden.png")
    assert (read_picture(tmp_path / "hidden.png").rgb == 255).all()


def test_an_opaque_alpha_channel_is_no_alpha(tmp_path: Path) -> None:
    two_halves().convert("RGBA").save(tmp_path / "opaque.png")
    assert read_picture(tmp_path / "opaque.png").alpha is None


def test_of_an_animation_the_first_frame_is_read_and_this_is_said(tmp_path: Path) -> None:
    frames = [Image.new("RGB", (12, 12), colour) for colour in (RED, BLUE, (0, 200, 0))]
    frames[0].save(tmp_path / "moving.gif", save_all=True, append_images=frames[1:])
    picture = read_picture(tmp_path / "moving.gif")
    assert picture.notes == ("animated: first of 3 frames",)
    assert close(picture.rgb[5, 5], RED)


def test_the_content_counts_and_not_the_suffix(tmp_path: Path) -> None:
    path = tmp_path / "it is a [webp] = ü.jpg"
    two_halves().save(path, format="WEBP", lossless=True)
    picture = read_picture(str(path))
    assert tuple(picture.rgb[0, 0]) == RED
    assert picture.path == path


def header_only_png(path: Path, width: int, height: int) -> None:
    """A PNG that claims a size and carries no pixels."""
    header = b"IHDR" + struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = struct.pack(">I", 13) + header + struct.pack(">I", zlib.crc32(header))
    data = b"IDAT" + zlib.compress(b"\0")
    chunks += struct.pack(">I", len(data) - 4) + data + struct.pack(">I", zlib.crc32(data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunks)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("side", [7_100, 13_000, 60_000])
def test_a_bomb_is_refused_by_its_header(tmp_path: Path, side: int) -> None:
    header_only_png(tmp_path / "bomb.png", side, side)
    with pytest.raises(PictureError, match="megapixels, the limit is 50; make the picture smaller"):
        read_picture(tmp_path / "bomb.png")


@pytest.mark.parametrize("name", ["cut.png", "cut.jpg", "cut.webp", "cut.tiff"])
def test_a_truncated_file_is_one_clear_line(tmp_path: Path, name: str) -> None:
    noise = np.random.default_rng(0).integers(0, 255, (64, 64, 3), dtype=np.uint8)
    Image.fromarray(noise).save(tmp_path / name)
    whole = (tmp_path / name).read_bytes()
    (tmp_path / name).write_bytes(whole[: len(whole) // 2])
    with pytest.raises(PictureError, match=name) as caught:
        read_picture(tmp_path / name)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("text.png", b"this is no picture\n", "not a picture that can be read; give a PNG, JPEG or WebP file"),
        ("empty.png", b"", "the file is empty"),
        ("missing.png", None, "no such file"),
    ],
)
def test_what_is_no_picture_is_one_clear_line(tmp_path: Path, name: str, content: bytes | None, message: str) -> None:
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(PictureError, match=message) as caught:
        read_picture(tmp_path / name)
    assert str(tmp_path / name) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_folder_is_no_picture(tmp_path: Path) -> None:
    with pytest.raises(PictureError, match="is a folder, not a picture"):
        read_picture(tmp_path)
