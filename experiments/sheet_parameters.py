"""Pages of the parameter sheet: one parameter a row, one value a column, all else as it stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PIL import Image, ImageDraw

from experiments.sheet_cells import Cell
from experiments.sheet_paper import (
    FAINT,
    GAP,
    INK,
    LINE,
    LINE_HEIGHT,
    MARGIN,
    MARK,
    NAME,
    TEXT,
    TEXT_INK,
    new_page,
    put_panel,
    put_reason,
    wrapped,
)
from experiments.sheet_values import nearest, written
from treefit.asset.pictures.font import fitted, font
from treefit.plant import Parameter, Value

ROWS, COLUMNS = 12, 5
"""Parameters a page, and values beside each other; more go on below."""

MASK_SHARE = 0.56
"""Height of a mask beside a picture, by that of the picture."""

Sizes = Sequence[tuple[int, int]]
_HEAD = 236  # pixels of the words before a row
_CAPTION = TEXT + 10  # under the panels


@dataclass(frozen=True, eq=False)
class Row:
    """A parameter at `values`, by itself at `usual`; `fixed`: the search leaves it alone; `on`: a preset, if on one."""

    parameter: Parameter
    usual: Value
    fixed: bool
    values: Sequence[Value]
    cells: Sequence[Cell]
    on: str = ""

    @property
    def unseen(self) -> bool:
        """Whether all plants look alike to the pixel; a row of one plant tells nothing."""
        drawn = [cell for cell in self.cells if not cell.failure]
        return len(drawn) > 1 and all(cell.looks_like(drawn[0]) for cell in drawn)


def parameter_pages(rows: Sequence[Row], sizes: Sizes, title: str, legend: str) -> list[Image.Image]:
    """Pages of about the same length; panels of a cell have `sizes` (height, width)."""
    size = -(-len(rows) // -(-len(rows) // ROWS))
    parts = [(first, rows[first : first + size]) for first in range(0, len(rows), size)]
    which = [f" {first + 1} to {first + len(part)} of {len(rows)}" if len(parts) > 1 else "" for first, part in parts]
    return [_page(part, sizes, title + shown, legend) for (_, part), shown in zip(parts, which, strict=True)]


def _page(rows: Sequence[Row], sizes: Sizes, title: str, legend: str) -> Image.Image:
    height = max(tall for tall, _ in sizes)
    width = sum(wide for _, wide in sizes) + (len(sizes) - 1) * GAP // 2
    columns = min(COLUMNS, max(len(row.cells) for row in rows))
    step = height + _CAPTION + 16
    whole = 2 * MARGIN + _HEAD + columns * (width + 2 * GAP) - 2 * GAP
    lines = [-(-len(row.cells) // columns) for row in rows]
    page, first = new_page(whole, sum(lines) * step - 24, title, legend)
    draw = ImageDraw.Draw(page)
    for i, row in enumerate(rows):
        head = first + sum(lines[:i]) * step
        if i:
            draw.line((MARGIN, head - 9, whole - MARGIN, head - 9), LINE)
        _put_head(draw, row, head, height)
        marked = nearest(row.parameter, row.values, row.usual)
        for j, (value, cell) in enumerate(zip(row.values, row.cells, strict=True)):
            left, top = MARGIN + _HEAD + j % columns * (width + 2 * GAP), head + j // columns * step
            _put_cell(page, cell, left, top, width, height)
            _put_value(draw, written(value, row.parameter.unit), j == marked, left, top + height + 4, width)
    return page


def _put_head(draw: ImageDraw.ImageDraw, row: Row, top: int, height: int) -> None:
    """Name, what the parameter is, its value otherwise, on which plant, and what there is to know of it."""
    parameter, room = row.parameter, _HEAD - 24
    draw.text((MARGIN, top - 2), fitted(parameter.name, NAME, room), INK, font(NAME))
    share = " (a share)" if parameter.unit == "share" else ""
    facts = [(f"otherwise {written(row.usual, parameter.unit)}{share}", FAINT)]
    facts = [(f"on {row.on}", MARK), *facts] if row.on else facts
    facts += [("not searched", FAINT)] if row.fixed else []
    facts += [("no pixel changes", MARK)] if row.unseen else []
    most = max(1, (height - NAME) // LINE_HEIGHT - len(facts))
    lines = [(line, TEXT_INK) for line in wrapped(parameter.doc, TEXT, room, most)] + facts
    for k, (line, colour) in enumerate(lines):
        draw.text((MARGIN, top + NAME + 8 + k * LINE_HEIGHT), line, colour, font(TEXT))


def _put_cell(page: Image.Image, cell: Cell, left: int, top: int, width: int, height: int) -> None:
    """Picture, and the mask beside it on the same ground."""
    if cell.failure:
        put_reason(page, cell.failure, left, top, width, height)
        return
    for panel in (cell.shaded, cell.mask):
        if panel is not None:
            put_panel(page, panel, left, top + height - len(panel))
            left += panel.shape[1] + GAP // 2


def _put_value(draw: ImageDraw.ImageDraw, text: str, marked: bool, left: int, top: int, width: int) -> None:
    """The value under its cell; that which is nearest to the usual one has a dot before it."""
    if marked:
        draw.text((left, top), "●", MARK, font(TEXT - 1))
    draw.text((left + (13 if marked else 1), top), fitted(text, TEXT, width - 13), INK if marked else FAINT, font(TEXT))
