"""Gallery: the picture and its mask beside those of the candidates, all trees at one height on one baseline."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from treefit.asset.pictures.font import fitted, font
from treefit.asset.pictures.frame import BASE_SHARE, TREE_SHARE
from treefit.mask import PALETTE, Mask, check_mask

Picture = NDArray[np.uint8]  # (h, w, 3) sRGB

_HEIGHT = 420  # pixels of a panel
_NARROWEST, _WIDEST = 0.6, 1.6  # widths of panels in their heights
_MARGIN, _GAP = 32, 14
_PAPER, _INK, _FAINT, _LINE = (255, 255, 255), (34, 34, 34), (110, 110, 110), (222, 222, 222)
_TITLE, _NAME, _CAPTION = 22, 15, 12  # font sizes
_TOP = _MARGIN + _TITLE + 18


@dataclass(frozen=True, eq=False)
class GalleryEntry:
    """One candidate: its picture (drawn by `picture`), its mask and the lines written under both."""

    name: str
    picture: Picture
    mask: Mask
    caption: Sequence[str] = field(default_factory=tuple)


@dataclass(frozen=True)
class _Tree:
    """Where a tree stands in an image, in pixels of that image."""

    base: float  # row of the lowest part
    middle: float  # column of the trunk base
    tall: float


def gallery(picture_rgb: Picture, target_mask: Mask, entries: Sequence[GalleryEntry], title: str) -> Picture:
    """Return one image (h, w, 3): pictures in the upper row, masks in the lower one, captions below.

    `picture_rgb` and `target_mask` show the same frame; they may differ in size.
    """
    columns = [_given_column(picture_rgb, check_mask(target_mask)), *(_drawn_column(entry) for entry in entries)]
    return _page(columns, title)


@dataclass(frozen=True, eq=False)
class _Column:
    """Two panels of one size, one above the other, and what is written under them."""

    panels: tuple[Image.Image, Image.Image]
    name: str
    caption: Sequence[str]

    @property
    def width(self) -> int:
        """Pixels, of the panels and of the text."""
        text = [font(_CAPTION).getlength(line) for line in self.caption] + [font(_NAME).getlength(self.name)]
        return max(self.panels[0].width, int(min(max(text) + 1, _HEIGHT * _WIDEST)))


def _page(columns: list[_Column], title: str) -> Picture:
    """Lay the columns out on paper."""
    lines = max(len(column.caption) for column in columns)
    text = _TOP + 2 * (_HEIGHT + _GAP)
    width = 2 * _MARGIN + sum(column.width + _GAP for column in columns) - _GAP
    page = Image.new("RGB", (width, text + _NAME + 12 + lines * (_CAPTION + 6) + _MARGIN - 6), _PAPER)
    draw = ImageDraw.Draw(page)
    draw.text((_MARGIN, _MARGIN - 6), fitted(title, _TITLE, width - 2 * _MARGIN), _INK, font(_TITLE))
    left = _MARGIN
    for column in columns:
        for row, panel in enumerate(column.panels):
            place = (left, _TOP + row * (_HEIGHT + _GAP))
            page.paste(_cut_to(panel, column.width), place)
            draw.rectangle((*place, place[0] + column.width - 1, place[1] + _HEIGHT - 1), outline=_LINE)
        draw.text((left, text), fitted(column.name, _NAME, column.width), _INK, font(_NAME))
        for j, line in enumerate(column.caption):
            at = (left, text + _NAME + 12 + j * (_CAPTION + 6))
            draw.text(at, fitted(line, _CAPTION, column.width), _FAINT, font(_CAPTION))
        left += column.width + _GAP
    return np.asarray(page, dtype=np.uint8)


def _given_column(picture_rgb: Picture, mask: Mask) -> _Column:
    """The picture over its mask, as wide as the picture is at that scale (within the limits of a panel)."""
    tree = _tree_in(mask)
    down, across = picture_rgb.shape[0] / mask.shape[0], picture_rgb.shape[1] / mask.shape[1]
    in_picture = _Tree(tree.base * down, tree.middle * across, tree.tall * down)
    scale = TREE_SHARE * _HEIGHT / in_picture.tall
    left, right = (scale * (column - in_picture.middle) for column in (0, picture_rgb.shape[1]))
    limit = _HEIGHT * _WIDEST / 2
    span = (max(left, -limit), max(min(right, limit), max(left, -limit) + _HEIGHT * _NARROWEST))
    upper = _stand(Image.fromarray(picture_rgb), in_picture, span, Image.Resampling.LANCZOS)
    return _Column((upper, _stand(_coloured(mask), tree, span, Image.Resampling.BOX)), "picture", ("and its mask",))


def _drawn_column(entry: GalleryEntry) -> _Column:
    """A candidate's picture, whose frame is that of `picture`, over its mask."""
    image = Image.fromarray(entry.picture)
    width = round(min(max(image.width / image.height, _NARROWEST), _WIDEST) * _HEIGHT)
    upper = image.resize((max(1, round(image.width * _HEIGHT / image.height)), _HEIGHT), Image.Resampling.LANCZOS)
    mask = check_mask(entry.mask)
    lower = _stand(_coloured(mask), _tree_in(mask), (-width / 2, width / 2), Image.Resampling.BOX)
    return _Column((_cut_to(upper, width), lower), entry.name, tuple(entry.caption))


def _coloured(mask: Mask) -> Image.Image:
    return Image.fromarray(np.array(PALETTE, dtype=np.uint8)[mask])


def _stand(image: Image.Image, tree: _Tree, span: tuple[float, float], how: Image.Resampling) -> Image.Image:
    """Panel with the tree of `image` at the common height and baseline; `span`: its edges from the trunk, in pixels."""
    scale = TREE_SHARE * _HEIGHT / tree.tall
    left, top = tree.middle + span[0] / scale, tree.base - BASE_SHARE * _HEIGHT / scale
    width = round(span[1] - span[0])
    inside = (
        max(left, 0),
        max(top, 0),
        min(left + width / scale, image.width),
        min(top + _HEIGHT / scale, image.height),
    )
    panel = Image.new("RGB", (width, _HEIGHT), _PAPER)
    if inside[0] < inside[2] and inside[1] < inside[3]:
        corner = round((inside[0] - left) * scale), round((inside[1] - top) * scale)
        size = max(round((inside[2] - inside[0]) * scale), 1), max(round((inside[3] - inside[1]) * scale), 1)
        panel.paste(image.resize(size, how, box=inside), corner)
    return panel


def _cut_to(panel: Image.Image, width: int) -> Image.Image:
    """Return the middle `width` columns of a panel; the edge columns are repeated where it is narrower."""
    spare = panel.width - width
    if spare >= 0:
        return panel.crop((spare // 2, 0, spare // 2 + width, panel.height))
    before = -spare // 2
    return Image.fromarray(np.pad(np.asarray(panel), ((0, 0), (before, -spare - before), (0, 0)), mode="edge"))


def _tree_in(mask: Mask) -> _Tree:
    """Find the tree in a mask (h, w); an empty mask counts as a tree that fills it."""
    h, w = mask.shape
    rows = np.flatnonzero(mask.any(axis=1))
    if len(rows) == 0:
        return _Tree(h, w / 2, h)
    top, base = int(rows[0]), int(rows[-1]) + 1
    foot = np.flatnonzero(mask[base - 1 - (base - top) // 50 : base].any(axis=0))
    return _Tree(base, float(foot.mean()) + 0.5, base - top)
