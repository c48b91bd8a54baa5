"""Font of the pictures, one that has the letters of most file names, and text that fits into its room."""

from __future__ import annotations

from bisect import bisect_right
from functools import cache
from pathlib import Path

import matplotlib as mpl
from PIL import ImageFont


@cache
def font(size: float) -> ImageFont.FreeTypeFont:
    """DejaVu Sans, `size` pixels high; it comes with matplotlib."""
    file = Path(mpl.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"
    return ImageFont.truetype(file, size, layout_engine=ImageFont.Layout.BASIC)  # Raqm fails on control characters


def fitted(text: str, size: float, room: float) -> str:
    """Return `text` on one line, shortened with an ellipsis where it is wider than `room` pixels."""
    letters, text = font(size), " ".join(text.split())
    if letters.getlength(text) <= room:
        return text
    first = bisect_right(range(len(text)), room, key=lambda end: letters.getlength(f"{text[:end].rstrip()}…"))
    return f"{text[: max(first - 1, 0)].rstrip()}…"
