"""Gallery: the picture and its mask beside those of the candidates, all trees at one height on one baseline."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from PIL import Image, ImageDraw

from treefit.asset.pictures.font import bold, fitted, font
from treefit.asset.pictures.panels import WIDEST, Panels, Picture, drawn_panels, given_panels, paste_rounded
from treefit.mask import Mask, check_mask

PAPER, INK, FAINT = (246, 245, 242), (38, 38, 36), (118, 117, 112)

_HEIGHT = 420  # pixels of a panel
_MARGIN, _GAP = 40, 16
_TITLE, _NAME, _CAPTION = 23, 16, 12.5  # font sizes
_LINE = 20  # pixels from one line of a caption to the next
_TOP = _MARGIN + _TITLE + 24
_BOTTOM = _MARGIN - 8


@dataclass(frozen=True, eq=False)
class GalleryEntry:
    """One candidate: its picture (drawn by `picture`), its mask and the lines written under both."""

    name: str
    picture: Picture
    mask: Mask
    caption: Sequence[str] = field(default_factory=tuple)


def gallery(picture_rgb: Picture, target_mask: Mask, entries: Sequence[GalleryEntry], title: str) -> Picture:
    """Return one image (h, w, 3): pictures in the upper row, masks in the lower one, captions below.

    `picture_rgb` and `target_mask` show the same frame; they may differ in size.
    """
    given = _Column(given_panels(picture_rgb, check_mask(target_mask), _HEIGHT), "picture", ("and its mask",))
    drawn = (
        _Column(drawn_panels(entry.picture, check_mask(entry.mask), _HEIGHT), entry.name, entry.caption)
        for entry in entries
    )
    return _page([given, *drawn], title)


@dataclass(frozen=True, eq=False)
class _Column:
    """Two panels of one size, one above the other, and what is written under them."""

    panels: Panels
    name: str
    caption: Sequence[str]

    @property
    def width(self) -> int:
        """Pixels, of the panels and of the text."""
        text = [font(_CAPTION).getlength(line) for line in self.caption] + [bold(_NAME).getlength(self.name)]
        return max(self.panels.width, int(min(max(text) + 1, _HEIGHT * WIDEST)))


def _page(columns: list[_Column], title: str) -> Picture:
    """Lay the columns out on paper."""
    lines = max(len(column.caption) for column in columns)
    text = _TOP + 2 * (_HEIGHT + _GAP) + 2
    width = 2 * _MARGIN + sum(column.width + _GAP for column in columns) - _GAP
    page = Image.new("RGB", (width, text + _NAME + 12 + lines * _LINE + _BOTTOM), PAPER)
    draw = ImageDraw.Draw(page)
    draw.text((_MARGIN, _MARGIN - 6), fitted(title, _TITLE, width - 2 * _MARGIN, bold), INK, bold(_TITLE))
    left = _MARGIN
    for column in columns:
        panels = column.panels.widened(column.width)
        paste_rounded(page, panels.picture, (left, _TOP))
        paste_rounded(page, panels.mask, (left, _TOP + _HEIGHT + _GAP))
        draw.text((left, text), fitted(column.name, _NAME, column.width, bold), INK, bold(_NAME))
        for j, line in enumerate(column.caption):
            at = (left, text + _NAME + 12 + j * _LINE)
            draw.text(at, fitted(line, _CAPTION, column.width), FAINT, font(_CAPTION))
        left += column.width + _GAP
    return np.asarray(page, dtype=np.uint8)
