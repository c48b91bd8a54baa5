"""Font of the pictures, one that has the letters of most file names, and text that fits into its room."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from functools import cache
from pathlib import Path

import matplotlib as mpl
from PIL import ImageFont

Font = ImageFont.FreeTypeFont


@cache
def font(size: float) -> Font:
    """DejaVu Sans, `size` pixels high; it comes with matplotlib."""
    return _dejavu("DejaVuSans.ttf", size)


@cache
def bold(size: float) -> Font:
    """DejaVu Sans in bold."""
    return _dejavu("DejaVuSans-Bold.ttf", size)


def _dejavu(name: str, size: float) -> Font:
    file = Path(mpl.get_data_path()) / "fonts" / "ttf" / name
    return ImageFont.truetype(file, size, layout_engine=ImageFont.Layout.BASIC)  # Raqm fails on control characters


def fitted(text: str, size: float, room: float, face: Callable[[float], Font] = font) -> str:
    """Return `text` on one line, shortened with an ellipsis where it is wider than `room` pixels."""
    letters, text = face(size), " ".join(text.split())
    if letters.getlength(text) <= room:
        return text
    first = bisect_right(range(len(text)), room, key=lambda end: letters.getlength(f"{text[:end].rstrip()}…"))
    return f"{text[: max(first - 1, 0)].rstrip()}…"
