"""sweep.png: the table of a sweep as one picture."""

from __future__ import annotations

from pathlib import Path

from PIL import Image, ImageDraw

from experiments.sweep_table import Job, SweepTable
from treefit.asset.pictures.font import font
from treefit.image import PictureError, read_picture

CELL, GAP, CAPTION, HEAD = 256, 16, 40, 44
INK, SOFT, RED, PAPER = (34, 34, 34), (120, 120, 120), (192, 57, 43), (246, 246, 244)
WIDEST = 40
"""Columns or rows that are drawn: a picture of more could not be opened."""


def thumbnail(path: Path, size: int = CELL) -> Image.Image | None:
    """Picture at `path` on white, at most `size` wide and high; None when it cannot be read."""
    try:
        image = Image.fromarray(read_picture(path).rgb)
    except PictureError:
        return None
    image.thumbnail((size, size))
    return image


def write_picture(table: SweepTable, file: Path) -> None:
    """Write `table` to the PNG `file`: a row a picture, a column a choice."""
    rows, columns = table.rows[:WIDEST], table.columns[:WIDEST]
    width, height = GAP + (len(columns) + 1) * (CELL + GAP), HEAD + len(rows) * (CELL + CAPTION + GAP)
    sheet = Image.new("RGB", (width, height), PAPER)
    for x, column in enumerate(columns, start=1):
        _text(sheet, column, (_left(x), 12), INK)
    for y, row in enumerate(rows):
        _place(sheet, thumbnail(Path(row)), 0, y)
        _text(sheet, Path(row).name, (_left(0), _top(y) + CELL + 8), INK)
        for x, column in enumerate(columns, start=1):
            job = table.cells.get((row, column))
            if job is not None:
                _draw_job(sheet, job, x, y)
    sheet.save(file)


def _draw_job(sheet: Image.Image, job: Job, x: int, y: int) -> None:
    caption = (_left(x), _top(y) + CELL + 8)
    if job.status != "done":
        _place(sheet, None, x, y)
        _text(sheet, f"{job.status}: {job.error}", caption, RED)
        return
    _place(sheet, thumbnail(job.picture) if job.picture else None, x, y)
    if job.score is not None:
        _text(sheet, f"{job.score:.3f}", caption, INK)
    if job.score_other_seeds is not None:
        _text(sheet, f"{job.score_other_seeds:.3f} on other seeds", (caption[0] + 62, caption[1]), SOFT)


def _place(sheet: Image.Image, image: Image.Image | None, x: int, y: int) -> None:
    left, top = _left(x), _top(y)
    ImageDraw.Draw(sheet).rectangle((left, top, left + CELL - 1, top + CELL - 1), fill="white")
    if image is not None:
        sheet.paste(image, (left + (CELL - image.width) // 2, top + (CELL - image.height) // 2))


def _text(sheet: Image.Image, text: str, at: tuple[int, int], colour: tuple[int, int, int]) -> None:
    """Write `text` on one line, cut to the width of a cell."""
    letters = font(16)
    shown = text
    while len(shown) > 1 and letters.getlength(shown) > CELL - max(0, (at[0] - GAP) % (CELL + GAP)):
        shown = shown.rstrip("…")[:-1] + "…"
    ImageDraw.Draw(sheet).text(at, shown, fill=colour, font=letters)


def _left(x: int) -> int:
    return GAP + x * (CELL + GAP)


def _top(y: int) -> int:
    return HEAD + y * (CELL + CAPTION + GAP)
