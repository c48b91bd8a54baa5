"""Large pictures: 40 megapixels are read and masked in little memory, 60 are refused."""

import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image

from tests.image.scene import scene
from tests.image.test_read import header_only_png
from treefit.image.read import PictureError, read_picture

LIMIT = 2 * 2**30
"""Bytes of memory that one picture may take, with all that the program is."""

MASK = """
import pathlib, resource, sys
from treefit.image import AutoMask, read_picture
mask = AutoMask()(read_picture(sys.argv[1])).mask
status = pathlib.Path("/proc/self/status")  # Linux's ru_maxrss begins with what the tests took before they started us
if status.exists():
    most = next(int(line.split()[1]) for line in status.read_text().splitlines() if line.startswith("VmHWM")) * 1024
else:
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
print(*mask.shape, most)
"""


def test_60_megapixels_are_refused(tmp_path: Path) -> None:
    header_only_png(tmp_path / "large.png", 10_000, 6_000)
    with pytest.raises(PictureError, match="10000 x 6000 = 60 megapixels, the limit is 50; make the picture smaller"):
        read_picture(tmp_path / "large.png")


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="has no getrusage")
def test_40_megapixels_are_masked_within_2_gibibytes(tmp_path: Path) -> None:
    image = Image.fromarray(scene().rgb).crop((0, 0, 200, 300)).resize((5_160, 7_740), Image.Resampling.NEAREST)
    image.save(tmp_path / "large.jpg", quality=60)
    process = subprocess.run(
        [sys.executable, "-c", MASK, str(tmp_path / "large.jpg")], capture_output=True, text=True, check=True
    )
    height, width, memory = (int(number) for number in process.stdout.split())
    assert (height, width) == (7_740, 5_160)
    assert memory < LIMIT
