"""Figures 1 and 2 of the paper: picture, mask and division into stripes of the picture and of every candidate."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw

from treefit.asset import GalleryEntry
from treefit.asset.pictures.font import bold, fitted, font
from treefit.asset.pictures.frame import BASE_SHARE, TREE_SHARE
from treefit.asset.pictures.gallery import FAINT, INK, PAPER
from treefit.asset.pictures.panels import Panels, Picture, drawn_panels, given_panels, paste_rounded
from treefit.mask import Mask, check_mask
from treefit.similarity.stripes import Stripes, stripes
from treefit.view.frame import BitMask, frame_for, sample

_HEIGHT = 300  # pixels of a panel
_MARGIN, _GAP, _BETWEEN = 36, 14, 26
_NAME, _SMALL = 15, 12
_FINER = 3  # stripes are drawn so many times larger than they are shown
_ROWS = 240  # of the mask that is divided, at least

_EMPTY = (252, 252, 250)
_TRUNK = ((244, 238, 231), (204, 177, 152), (186, 152, 122), (112, 74, 48))  # beside, a to d, b to c, lines
_CROWN = ((237, 244, 233), (202, 224, 190), (142, 188, 120), (46, 104, 38))
_LEGEND = (
    "Brown stripes have more branch than leaf pixels, green ones more leaf pixels. "
    "a, d: borders of the crown; b, c: of the dense crown, columns with over 75 % leaf pixels (paper, sec. 4)."
)


def stripes_figure(
    picture_rgb: Picture, mask: Mask, entries: Sequence[GalleryEntry], count: int = 24, title: str = ""
) -> Picture:
    """Return one image (h, w, 3): a row each for the picture and the candidates, of render, mask and `count` stripes.

    `picture_rgb` and `mask` show the same frame; a tree stands at one height on one baseline in all panels.
    """
    rows: list[tuple[str, Sequence[str], Panels, Mask]] = [
        ("picture", (), given_panels(picture_rgb, check_mask(mask), _HEIGHT), mask)
    ]
    for entry in entries:
        panels = drawn_panels(entry.picture, check_mask(entry.mask), _HEIGHT)
        rows.append((entry.name, entry.caption[:1], panels, entry.mask))
    wide = max(panels.width for _, _, panels, _ in rows)
    page, draw = _page(wide, len(rows), title)
    top = _MARGIN + (2 * _NAME if title else 0)
    for name, caption, panels, tree in rows:
        _write_name(draw, top, name, caption, 3 * wide + 2 * _GAP)
        for i, cell in enumerate((panels.picture, panels.mask, stripes_panel(tree, count, panels))):
            paste_rounded(page, cell, (_MARGIN + i * (wide + _GAP), top + _NAME + 10))
        top += _NAME + 10 + _HEIGHT + _BETWEEN
    _write_legend(draw, top - 6, 3 * wide + 2 * _GAP)
    return np.asarray(page, dtype=np.uint8)


def stripes_panel(mask: Mask, count: int, panels: Panels) -> Image.Image:
    """Return the stripes of `mask` as a panel like `panels`, with a, b, c, d as lines in each of them."""
    k, unit = _FINER, _FINER * TREE_SHARE * _HEIGHT  # pixels a plant height
    image = Image.new("RGB", (panels.width * k, _HEIGHT * k), _EMPTY)
    if mask.any():
        frame = frame_for(mask, -(-_ROWS // count) * count)
        _draw_stripes(ImageDraw.Draw(image), stripes(BitMask.pack(sample(mask, frame)), count), panels.middle * k, unit)
    return image.resize((panels.width, _HEIGHT), Image.Resampling.BOX)


def _draw_stripes(draw: ImageDraw.ImageDraw, found: Stripes, middle: float, unit: float) -> None:
    top, width, step = (BASE_SHARE - TREE_SHARE) / TREE_SHARE * unit, draw.im.size[0], unit / len(found)
    for i in range(len(found)):
        first, last = top + i * step, top + (i + 1) * step - min(_FINER, step / 4)
        (a, d), (b, c) = middle + unit * found.crown[i], middle + unit * found.dense[i]
        if d <= a:
            continue
        beside, between, dense, line = _TRUNK if found.branch[i] > found.foliage[i] else _CROWN
        draw.rectangle((0, first, width, last), beside)
        draw.rectangle((a, first, d, last), between)
        if c > b:
            draw.rectangle((b, first, c, last), dense)
            for x in (b, c):
                draw.line((x, first, x, last), line, _FINER)
        for x in (a, d):
            draw.line((x, first, x, last), line, 2 * _FINER)
    _write_letters(draw, found, middle, unit)


def _write_letters(draw: ImageDraw.ImageDraw, found: Stripes, middle: float, unit: float) -> None:
    """Write a, b, c, d over the stripe in which they are farthest apart, unless there is no dense crown."""
    (a, d), (b, c) = found.crown.T, found.dense.T
    apart = np.minimum(c - b, np.minimum(b - a, d - c) + 0.1 * (c - b))
    at = int(np.argmax(apart))
    if apart[at] <= 0:
        return
    size = 12 * _FINER
    row = (BASE_SHARE - TREE_SHARE) / TREE_SHARE * unit + at * unit / len(found) - 1.25 * size
    for letter, x in zip("abcd", (a[at], b[at], c[at], d[at]), strict=True):
        column = min(max(middle + unit * x, 0.7 * size), draw.im.size[0] - 0.7 * size)
        draw.rounded_rectangle(
            (column - 0.5 * size, row - 0.05 * size, column + 0.5 * size, row + 1.1 * size), 9, _EMPTY
        )
        draw.text((column, row + 0.5 * size), letter, INK, bold(size), anchor="mm")


def _page(wide: int, rows: int, title: str) -> tuple[Image.Image, ImageDraw.ImageDraw]:
    width = 2 * _MARGIN + 3 * wide + 2 * _GAP
    head = 2 * _NAME if title else 0
    height = 2 * _MARGIN + head + rows * (_NAME + 10 + _HEIGHT + _BETWEEN) + 2 * _SMALL
    page = Image.new("RGB", (width, height), PAPER)
    draw = ImageDraw.Draw(page)
    if title:
        draw.text((_MARGIN, _MARGIN - 10), fitted(title, 20, width - 2 * _MARGIN, bold), INK, bold(20))
    return page, draw


def _write_name(draw: ImageDraw.ImageDraw, top: int, name: str, caption: Sequence[str], room: int) -> None:
    shown = fitted(name, _NAME, room, bold)
    draw.text((_MARGIN, top), shown, INK, bold(_NAME))
    left = bold(_NAME).getlength(shown) + 12
    for line in caption:
        draw.text((_MARGIN + left, top + 3), fitted(line, _SMALL, max(room - left, 1)), FAINT, font(_SMALL))


def _write_legend(draw: ImageDraw.ImageDraw, top: int, room: int) -> None:
    """Write the legend on as many lines as it needs."""
    line = ""
    for word in [*_LEGEND.split(), ""]:
        longer = f"{line} {word}".strip()
        if not word or font(_SMALL).getlength(longer) > room:
            draw.text((_MARGIN, top), line, FAINT, font(_SMALL))
            top, line = top + _SMALL + 6, word
        else:
            line = longer
