"""Damaged files: whatever bytes are wrong, there is a picture or one clear line."""

import io
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from treefit.image.read import PictureError, read_mask_file, read_picture

FORMATS = {"PNG": {}, "JPEG": {"quality": 90}, "WEBP": {"lossless": True}, "GIF": {}, "TIFF": {}, "BMP": {}}
TRIES = 60


def small(kind: str) -> bytes:
    rng = np.random.default_rng(1)
    image = Image.fromarray(rng.integers(0, 255, (12, 16, 3), dtype=np.uint8))
    file = io.BytesIO()
    image.save(file, format=kind, **FORMATS[kind])
    return file.getvalue()


def damaged(data: bytes, rng: np.random.Generator) -> bytes:
    """`data` with bytes changed, cut out, put in or cut off."""
    way, pixels = rng.integers(4), np.frombuffer(data, np.uint8)
    at, length = int(rng.integers(len(data))), int(rng.integers(1, 9))
    if way == 0:
        changed = pixels.copy()
        changed[rng.integers(len(data), size=length)] = rng.integers(0, 256, length)
        return changed.tobytes()
    if way == 1:
        return data[:at] + data[at + length :]
    if way == 2:
        return data[:at] + rng.bytes(length) + data[at:]
    return data[:at]


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("read", [read_picture, read_mask_file])
def test_a_damaged_file_is_a_picture_or_one_clear_line(
    tmp_path: Path, kind: str, read: Callable[[Path], object]
) -> None:
    rng = np.random.default_rng([7, len(kind)])
    data, path, refusals = small(kind), tmp_path / "damaged.png", []
    for _ in range(TRIES):
        path.write_bytes(damaged(data, rng))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # Pillow warns of damage that it can bear
                read(path)
        except PictureError as error:
            refusals.append(str(error))
    assert refusals
    assert all(str(path) in line and "\n" not in line for line in refusals)


@pytest.mark.parametrize("seed", range(20))
def test_noise_after_a_good_beginning_is_one_clear_line(tmp_path: Path, seed: int) -> None:
    rng = np.random.default_rng(seed)
    path = tmp_path / "noise.png"
    path.write_bytes(small("PNG")[: 8 + int(rng.integers(30))] + rng.bytes(300))
    with pytest.raises(PictureError, match=r"noise\.png"):
        read_picture(path)
