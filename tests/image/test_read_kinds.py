"""Kinds of picture files that are rarer: made here, each read as what it shows."""

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageCms, features

from tests.image.test_read import BLUE, RED, close, two_halves
from treefit.image import AutoMask, Help, HelpedMask
from treefit.image.read import PictureError, read_picture


def png(path: Path, width: int, height: int, depth: int, kind: int, pixels: bytes) -> None:
    """A PNG of `depth` bits and colour type `kind`, which Pillow itself may not write."""

    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    row = len(pixels) // height
    rows = b"".join(b"\0" + pixels[y * row : (y + 1) * row] for y in range(height))
    header = struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0)
    body = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + body)


def is_two_halves(path: Path) -> bool:
    picture = read_picture(path)
    return picture.shape == (20, 40) and close(picture.rgb[10, 5], RED) and close(picture.rgb[10, 35], BLUE)


@pytest.mark.parametrize("kind", [2, 6])
def test_sixteen_bits_a_channel_become_eight(tmp_path: Path, kind: int) -> None:
    pixels = np.asarray(two_halves().convert("RGB" if kind == 2 else "RGBA")).astype(">u2") * 257
    png(tmp_path / "deep.png", 40, 20, 16, kind, pixels.tobytes())
    assert is_two_halves(tmp_path / "deep.png")


def test_a_progressive_jpeg_with_a_colour_profile_is_read(tmp_path: Path) -> None:
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    two_halves().save(tmp_path / "p.jpg", progressive=True, icc_profile=profile, quality=95)
    assert is_two_halves(tmp_path / "p.jpg")


@pytest.mark.parametrize("suffix", ["bmp", "tiff", "tga", "ppm", "gif", "webp", "jp2", "avif"])
def test_other_formats_are_read_by_content(tmp_path: Path, suffix: str) -> None:
    needs = {"jp2": "jpg_2000", "avif": "avif"}.get(suffix)
    if needs and not features.check(needs):
        pytest.skip(f"Pillow without {needs}")
    two_halves().save(tmp_path / f"a.{suffix}")
    (tmp_path / f"a.{suffix}").rename(tmp_path / "a.jpg")
    assert is_two_halves(tmp_path / "a.jpg")


def test_black_and_white_of_one_bit_is_read(tmp_path: Path) -> None:
    two_halves().convert("L").point(lambda v: 255 * (v > 60)).convert("1").save(tmp_path / "bit.png")
    assert set(np.unique(read_picture(tmp_path / "bit.png").rgb)) == {0, 255}


def test_heic_is_named_in_the_error(tmp_path: Path) -> None:
    (tmp_path / "phone.heic").write_bytes(struct.pack(">I", 24) + b"ftypheic" + b"\0" * 200)
    with pytest.raises(PictureError, match=r"phone\.heic: HEIC is not read; give a PNG, JPEG or WebP file"):
        read_picture(tmp_path / "phone.heic")


@pytest.mark.parametrize("size", [(1, 1), (1, 3000), (3000, 1), (7, 3000)])
def test_a_strip_of_pixels_is_read_but_shows_no_tree(tmp_path: Path, size: tuple[int, int]) -> None:
    noise = np.random.default_rng(0).integers(0, 255, (size[1], size[0], 3), dtype=np.uint8)
    Image.fromarray(noise).save(tmp_path / "strip.png")
    picture = read_picture(tmp_path / "strip.png")
    assert picture.shape == (size[1], size[0])
    for extractor in (AutoMask(), HelpedMask(AutoMask(), Help(outline=((0, 0), (1, 0), (1, 1), (0, 1))))):
        with pytest.raises(PictureError, match="too small to show a tree"):
            extractor(picture)
