"""Font of the pictures: one that has the letters of most file names, shipped with matplotlib."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import matplotlib as mpl
from PIL import ImageFont


@cache
def font(size: float) -> ImageFont.FreeTypeFont:
    """DejaVu Sans, `size` pixels high."""
    file = Path(mpl.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"
    return ImageFont.truetype(file, size, layout_engine=ImageFont.Layout.BASIC)  # Raqm fails on control characters
