"""Paper of the sheets: colours, sizes of letters, panels, and text on several lines."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from treefit.asset.pictures.font import fitted, font

PAPER, LINE, MARK = (255, 255, 255), (224, 224, 224), (176, 82, 28)
INK, TEXT_INK, FAINT = (34, 34, 34), (72, 72, 72), (120, 120, 120)
BLANK = (248, 248, 246)  # of a panel without a plant
MARGIN, GAP = 32, 8
TITLE, NAME, TEXT = 22, 15, 12  # sizes of letters in pixels
LINE_HEIGHT = TEXT + 5


def new_page(width: int, height: int, title: str, legend: str) -> tuple[Image.Image, int]:
    """Paper with a title and words under it, and the row under them: from there on is room of `height` pixels."""
    lines = wrapped(legend, TEXT, width - 2 * MARGIN, 6)
    top = MARGIN + TITLE + 23 + len(lines) * LINE_HEIGHT
    page = Image.new("RGB", (width, top + height + MARGIN), PAPER)
    draw = ImageDraw.Draw(page)
    draw.text((MARGIN, MARGIN - 6), fitted(title, TITLE, width - 2 * MARGIN), INK, font(TITLE))
    for i, line in enumerate(lines):
        draw.text((MARGIN, MARGIN + TITLE + 5 + i * LINE_HEIGHT), line, FAINT, font(TEXT))
    return page, top


def put_panel(page: Image.Image, picture: NDArray[np.uint8], left: int, top: int) -> None:
    """A picture (h, w, 3) within a thin line."""
    height, width = picture.shape[:2]
    page.paste(Image.fromarray(picture), (left, top))
    ImageDraw.Draw(page).rectangle((left, top, left + width - 1, top + height - 1), outline=LINE)


def put_reason(page: Image.Image, reason: str, left: int, top: int, width: int, height: int) -> None:
    """An empty panel that says why there is no plant."""
    draw = ImageDraw.Draw(page)
    draw.rectangle((left, top, left + width - 1, top + height - 1), BLANK, LINE)
    lines = wrapped(reason, TEXT, width - 16, max(1, height // LINE_HEIGHT - 1))
    first = top + (height - LINE_HEIGHT * len(lines)) // 2
    for i, line in enumerate(lines):
        draw.text((left + width / 2, first + i * LINE_HEIGHT), line, FAINT, font(TEXT), anchor="ma")


def wrapped(text: str, size: int, room: float, most: int) -> list[str]:
    """Lines of `text` of `room` pixels at the size of letters, `most` at the most: the last one then ends with ..."""
    lines: list[str] = []
    words = text.split()
    while words and len(lines) < most:
        line = words.pop(0)
        while words and font(size).getlength(f"{line} {words[0]}") <= room:
            line += f" {words.pop(0)}"
        lines.append(line)
    if words:
        lines[-1] += f" {' '.join(words)}"
    return [fitted(line, size, room) for line in lines]
