"""The sheet of the task masks: every picture, and the mask of each extractor on it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from experiments.masks_measure import Found
from treefit.asset.pictures.font import fitted, font
from treefit.image import Picture, overlay
from treefit.image.picture import shrink
from treefit.image.resize import resize_mask

CELL, MARGIN, CAPTION, WIDTH = 230, 14, 38, 1660
"""Pixels of a panel's side, between panels, of the words under one, and of the sheet at most."""

_PAPER, _INK, _FAINT, _BAD = (255, 255, 255), (34, 34, 34), (125, 125, 125), (190, 30, 30)


def sheet(pictures: Mapping[str, Picture], found: Sequence[Found]) -> NDArray[np.uint8]:
    """Return one image (h, w, 3): panels of a picture stay together, as many pictures in a row as there is room for."""
    groups = {name: [one for one in found if one.name == name] for name in pictures}
    panels = 1 + max(map(len, groups.values()))
    columns = max(1, WIDTH // (panels * (CELL + MARGIN)))
    rows = -(-len(groups) // columns)
    width, height = columns * panels * (CELL + MARGIN) + MARGIN, rows * (CELL + CAPTION + MARGIN) + MARGIN
    page = Image.new("RGB", (width, height), _PAPER)
    for i, (name, group) in enumerate(groups.items()):
        left, top = MARGIN + i % columns * panels * (CELL + MARGIN), MARGIN + i // columns * (CELL + CAPTION + MARGIN)
        small = shrink(pictures[name], CELL)
        _put(page, small.rgb, left, top, name, "")
        for k, one in enumerate(group, start=1):
            at = left + k * (CELL + MARGIN)
            if one.extraction is None:
                _put(page, np.full_like(small.rgb, 240), at, top, one.method, one.error, _BAD)
                continue
            shown = overlay(small, resize_mask(one.extraction.mask, small.shape))
            _put(page, shown, at, top, f"{one.method}, {one.extraction.method}", _numbers(one))
    return np.asarray(page, dtype=np.uint8)


def _numbers(one: Found) -> str:
    assert one.extraction is not None
    sure = f"sure {one.extraction.confidence:.2f}"
    if one.agreement is None:
        return sure
    return f"tree {one.agreement['tree']:.2f}, classes {one.agreement['classes']:.2f}, {sure}"


def _put(
    page: Image.Image, panel: NDArray[np.uint8], left: int, top: int, name: str, words: str,
    colour: tuple[int, int, int] = _FAINT,
) -> None:  # fmt: skip
    height, width = panel.shape[:2]
    page.paste(Image.fromarray(panel), (left + (CELL - width) // 2, top + CELL - height))
    draw = ImageDraw.Draw(page)
    draw.text((left, top + CELL + 4), fitted(name, 13, CELL), _INK, font(13))
    draw.text((left, top + CELL + 20), fitted(words, 12, CELL), colour, font(12))
