"""Pages of the preset sheet: every preset of a generator on a few seeds, as pictures over masks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PIL import Image, ImageDraw

from experiments.sheet_cells import Cell
from experiments.sheet_paper import (
    FAINT,
    GAP,
    INK,
    LINE_HEIGHT,
    MARGIN,
    NAME,
    TEXT,
    new_page,
    put_panel,
    put_reason,
)
from treefit.asset.pictures.font import fitted, font

WIDEST = 1800
"""Pixels of a page, unless one preset is wider."""

ROWS = 8
"""Rows of presets a page."""

Sizes = Sequence[tuple[int, int]]
_BETWEEN = 36  # pixels between two presets
_HEAD = NAME + 10


@dataclass(frozen=True, eq=False)
class Block:
    """A preset on some seeds: a cell and the lines under it for each of them."""

    name: str
    cells: Sequence[Cell]
    captions: Sequence[Sequence[str]]


def preset_pages(blocks: Sequence[Block], sizes: Sizes, title: str, legend: str) -> list[Image.Image]:
    """Pages; panels of a cell have `sizes` (height, width), all of one width, one over the other."""
    heights, width = [tall for tall, _ in sizes], sizes[0][1]
    wide = len(blocks[0].cells) * (width + GAP) - GAP
    across = min(max(1, (WIDEST - 2 * MARGIN + _BETWEEN) // (wide + _BETWEEN)), len(blocks))
    size = across * ROWS
    parts = [blocks[i : i + size] for i in range(0, len(blocks), size)]
    return [_page(part, across, heights, width, title, legend) for part in parts]


def _page(
    blocks: Sequence[Block], across: int, heights: Sequence[int], width: int, title: str, legend: str
) -> Image.Image:
    wide = len(blocks[0].cells) * (width + GAP) - GAP
    lines = max(len(caption) for block in blocks for caption in block.captions)
    tall = _HEAD + sum(height + GAP for height in heights) + lines * LINE_HEIGHT
    rows = -(-len(blocks) // across)
    size = across * (wide + _BETWEEN) - _BETWEEN, rows * (tall + _BETWEEN) - _BETWEEN
    page, first = new_page(2 * MARGIN + size[0], size[1], title, legend)
    for i, block in enumerate(blocks):
        left, top = MARGIN + i % across * (wide + _BETWEEN), first + i // across * (tall + _BETWEEN)
        ImageDraw.Draw(page).text((left, top - 2), fitted(block.name, NAME, wide), INK, font(NAME))
        for j, (cell, caption) in enumerate(zip(block.cells, block.captions, strict=True)):
            _put_cell(page, cell, caption, left + j * (width + GAP), top + _HEAD, heights, width)
    return page


def _put_cell(
    page: Image.Image, cell: Cell, caption: Sequence[str], left: int, top: int, heights: Sequence[int], width: int
) -> None:
    """Picture, mask under it, and words under both."""
    whole = sum(height + GAP for height in heights) - GAP
    if cell.failure:
        put_reason(page, cell.failure, left, top, width, whole)
    else:
        below = top
        for panel in (cell.shaded, cell.mask):
            if panel is not None:
                put_panel(page, panel, left, below)
                below += len(panel) + GAP
    for k, line in enumerate(caption):
        at = (left, top + whole + 5 + k * LINE_HEIGHT)
        ImageDraw.Draw(page).text(at, fitted(line, TEXT, width), FAINT, font(TEXT))
