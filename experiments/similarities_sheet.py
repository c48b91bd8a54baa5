"""The sheet of the task similarities: the target of every picture beside the tree that each similarity found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from experiments.similarities_fit import JudgedFit, Study
from experiments.similarities_page import means
from treefit.asset.pictures.font import fitted, font
from treefit.mask import PALETTE, Mask

WIDTH = 1600
"""Pixels of the sheet, but for so few or so many columns that they would be too wide or too narrow."""

_MARGIN, _GAP = 24, 10
_NARROWEST, _WIDEST, _TALLEST = 112, 210, 230  # pixels of a panel
_TITLE, _NAME, _NUMBER = 20, 15, 13  # font sizes
_HEAD = _MARGIN + _TITLE + _NUMBER + 28  # where the names of the columns are
_TOP = _HEAD + 2 * _NAME + 32
_CAPTION = _NUMBER + 26  # under a panel, with the space to the next row
_PAPER, _INK, _FAINT, _LINE, _BEST = (255, 255, 255), (34, 34, 34), (125, 125, 125), (226, 226, 226), (30, 110, 40)
_ROOM = 1.35  # a row is as wide as its target times this at most; what a tree has beyond is cut off
_SHOWN = ("silhouette_iou", "class_iou", "texture")


def sheet(study: Study) -> NDArray[np.uint8]:
    """Return one image (h, w, 3): a row a picture, a column a similarity, all trees of a row at one scale."""
    names = list(study.mixes)
    cell = int(np.clip((WIDTH - 2 * _MARGIN + _GAP) / (len(names) + 1) - _GAP, _NARROWEST, _WIDEST))
    rows = [_Row.of(study, picture, cell) for picture in study.pictures]
    width = max(2 * _MARGIN + (len(names) + 1) * (cell + _GAP) - _GAP, 640)
    page = Image.new("RGB", (width, _TOP + sum(row.height + _CAPTION for row in rows) + _MARGIN // 2), _PAPER)
    _draw_head(page, study, cell)
    top = _TOP
    for row in rows:
        row.draw(page, top, cell)
        top += row.height + _CAPTION
    return np.asarray(page, dtype=np.uint8)


@dataclass(frozen=True, eq=False)
class _Row:
    """A picture's target and fits; `half` is the half width that is shown and `scale` makes pixels of the sheet."""

    picture: str
    target: Mask
    fits: Sequence[JudgedFit | None]
    half: int
    scale: float

    @classmethod
    def of(cls, study: Study, picture: str, cell: int) -> _Row:
        target = study.targets[picture]
        fits = [study.by_pair.get((picture, name)) for name in study.mixes]
        reach = max(_reach(mask) for mask in [target, *(fit.mask for fit in fits if fit)])
        half = min(reach, round(_reach(target) * _ROOM), target.shape[1] // 2)
        return cls(picture, target, fits, half, min(cell / (2 * half), _TALLEST / len(target)))

    @property
    def height(self) -> int:
        """Pixels of the panels."""
        return round(len(self.target) * self.scale)

    def draw(self, page: Image.Image, top: int, cell: int) -> None:
        """Draw the row under `top`."""
        draw, base = ImageDraw.Draw(page), top + self.height
        draw.line((_MARGIN, base, page.width - _MARGIN, base), _LINE)
        self._put(page, self.target, _left(0, cell), top, cell)
        draw.text(
            (_left(0, cell) + cell / 2, base + 5), fitted(self.picture, _NUMBER, cell), _INK, font(_NUMBER), anchor="ma"
        )
        best = {name: max((getattr(fit.agreement, name) for fit in self.fits if fit), default=0.0) for name in _SHOWN}
        for i, fit in enumerate(self.fits, start=1):
            if fit is None:
                draw.text((_left(i, cell) + cell / 2, base + 5), "failed", _FAINT, font(_NUMBER), anchor="ma")
                continue
            self._put(page, fit.mask, _left(i, cell), top, cell)
            numbers = [(getattr(fit.agreement, name), best[name]) for name in _SHOWN]
            _draw_numbers(draw, numbers, _left(i, cell) + cell / 2, base + 5)

    def _put(self, page: Image.Image, mask: Mask, left: int, top: int, cell: int) -> None:
        middle = mask.shape[1] // 2
        shown = Image.fromarray(np.array(PALETTE, np.uint8)[mask[:, middle - self.half : middle + self.half]])
        width = max(round(2 * self.half * self.scale), 1)
        page.paste(shown.resize((width, self.height), Image.Resampling.BOX), (left + (cell - width) // 2, top))


def _draw_head(page: Image.Image, study: Study, cell: int) -> None:
    """Title, and the name of every column with what its similarity reaches on average."""
    draw = ImageDraw.Draw(page)
    title = f"{study.generator}, {study.evaluations:,} evaluations"
    draw.text((_MARGIN, _MARGIN - 4), title, _INK, font(_TITLE))
    legend = "under each tree: silhouette IoU, class IoU, texture; the best of a row is green"
    draw.text((_MARGIN, _MARGIN + _TITLE + 4), legend, _FAINT, font(_NUMBER))
    middles = {name: [row[measure] for measure in _SHOWN] for name, row in means(study).items()}
    best = [max(numbers) for numbers in zip(*middles.values(), strict=True)]
    draw.text((_left(0, cell) + cell / 2, _HEAD), "picture", _INK, font(_NAME), anchor="ma")
    draw.text((_left(0, cell) + cell / 2, _HEAD + _NAME + 7), "mean", _FAINT, font(_NUMBER), anchor="ma")
    for i, name in enumerate(study.mixes, start=1):
        middle = _left(i, cell) + cell / 2
        draw.text((middle, _HEAD), fitted(name, _NAME, cell), _INK, font(_NAME), anchor="ma")
        if name in middles:
            _draw_numbers(draw, list(zip(middles[name], best, strict=True)), middle, _HEAD + _NAME + 7)


def _draw_numbers(draw: ImageDraw.ImageDraw, numbers: Sequence[tuple[float, float]], middle: float, top: float) -> None:
    """Numbers beside each other around `middle`, each green when it is as good as the best that comes with it."""
    letters, space = font(_NUMBER), 9
    texts = [f"{number:.2f}" for number, _ in numbers]
    left = middle - (sum(letters.getlength(text) for text in texts) + space * (len(texts) - 1)) / 2
    for text, (_, best) in zip(texts, numbers, strict=True):
        draw.text((left, top), text, _BEST if text == f"{best:.2f}" else _FAINT, letters)
        left += letters.getlength(text) + space


def _reach(mask: Mask) -> int:
    """Farthest column of the tree from the middle one, in pixels, at least 1."""
    columns, middle = np.flatnonzero(mask.any(axis=0)), mask.shape[1] / 2
    return int(np.ceil(max(middle - columns[0], columns[-1] + 1 - middle))) if len(columns) else 1


def _left(column: int, cell: int) -> int:
    return _MARGIN + column * (cell + _GAP)
