"""Page of a growth strip: plants of one scale beside each other in one landscape, with words under them."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from experiments.errors import one_line
from experiments.settings import Strip
from experiments.sheet_cells import THREADS, mask_panel, shaded_panel
from experiments.sheet_paper import (
    BLANK,
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
    wrapped,
)
from experiments.strip_rows import Place, Row, arranged
from treefit.asset import AssetSettings
from treefit.asset.pictures.font import fitted, font
from treefit.asset.pictures.frame import TREE_SHARE, Frame
from treefit.plant import Plant
from treefit.plant.extent import Extent, extent_of

WIDEST = 1800
"""Pixels of a page; what does not fit goes on below."""

_NARROWEST = 640  # pixels of a page, for its title
_LOWEST = 0.5  # height of a row of young plants, by that of the tallest
_BESIDE = 16  # pixels between two plants at least
_MARGINS = (46, 14)  # pixels left of the first plant, for the ruler, and right of the last
_TRUNK = 0.45  # radius of a trunk in pixels at least
_SHADOW = 0.6  # how far to the right a plant's shadow falls, by its height
_BETWEEN = 22  # pixels between two rows

Picture = NDArray[np.uint8]  # (h, w, 3) sRGB


@dataclass(frozen=True, eq=False)
class Moment:
    """A plant, or the reason why there is none; the words under it are its name and `facts`, a line each."""

    plant: Plant | str
    name: str
    facts: Sequence[str]


def strip_page(
    moments: Sequence[Moment], settings: Strip, asset: AssetSettings, title: str, legend: str
) -> Image.Image:
    """Picture of `moments` in their order, all at one scale; rows of one width, each on its own ground."""
    extents = [extent_of(one.plant) if isinstance(one.plant, Plant) else None for one in moments]
    room = WIDEST - 2 * MARGIN
    scale = scale_of([one for one in extents if one], settings.height, room - sum(_MARGINS) - 2 * _BESIDE)
    places = [_place(moment, extent, scale) for moment, extent in zip(moments, extents, strict=True)]
    rows = arranged(places, _MARGINS, room, _NARROWEST - 2 * MARGIN)
    lines = 1 + max(len(moment.facts) for moment in moments)
    words = 6 + NAME + (lines - 1) * LINE_HEIGHT + 4
    heights = [_row_height(extents[row.first : row.last], scale, settings.height) for row in rows]
    looks = ("shaded", "mask") if settings.look == "both" else (settings.look,)
    whole = sum(len(looks) * (height + GAP) - GAP + words + _BETWEEN for height in heights) - _BETWEEN
    page, top = new_page(2 * MARGIN + rows[0].width, whole, title, legend)
    for row, height in zip(rows, heights, strict=True):
        own = moments[row.first : row.last]
        for look in looks:
            _put_landscape(page, own, row, Frame(height, row.width, scale), look, asset, top)
            top += height + GAP
        _put_words(ImageDraw.Draw(page), own, row, top - GAP + 6)
        top += words + _BETWEEN - GAP
    return page


def scale_of(extents: Sequence[Extent], height: int, width: float) -> float:
    """Pixels a metre at which each plant has room in a picture of that height and width."""
    tall = max((extent.height for extent in extents), default=1.0)
    wide = max((extent.width for extent in extents), default=1.0)
    return min(TREE_SHARE * height / max(tall, 1e-6), width / max(wide, 1e-6))


def _place(moment: Moment, extent: Extent | None, scale: float) -> Place:
    """Room of a plant left and right of its trunk in pixels: for its crown, and for the words under it."""
    lengths = [font(NAME).getlength(moment.name), *(font(TEXT).getlength(fact) for fact in moment.facts)]
    half = max(lengths) / 2 if extent else 60.0
    left, right = (-extent.left * scale, extent.right * scale) if extent else (0.0, 0.0)
    return Place(max(left, half) + _BESIDE / 2, max(right, half) + _BESIDE / 2)


def _row_height(extents: Sequence[Extent | None], scale: float, height: int) -> int:
    """Pixels of a row, less for young plants."""
    tall = max((extent.height for extent in extents if extent), default=0.0)
    return round(min(max(tall * scale / TREE_SHARE, _LOWEST * height), height))


def _put_landscape(
    page: Image.Image, moments: Sequence[Moment], row: Row, frame: Frame, look: str, asset: AssetSettings, top: int
) -> None:
    def panel(moment: Moment) -> Picture | str:
        if isinstance(moment.plant, str):
            return moment.plant
        try:
            alone = _alone(moment.plant, frame)
            if look == "mask":
                return mask_panel(moment.plant, alone)
            return shaded_panel(sturdy(moment.plant, frame.scale), asset, alone)
        except Exception as error:
            return f"not drawn: {one_line(error)}"

    with ThreadPoolExecutor(THREADS) as pool:
        panels = list(pool.map(panel, moments))
    drawn = [(one, at) for one, at in zip(panels, row.trunks, strict=True) if not isinstance(one, str)]
    put_panel(page, _landscape(drawn, frame), MARGIN, top)
    if drawn:
        _put_ruler(ImageDraw.Draw(page), frame, top)
    for one, at, half in zip(panels, row.trunks, row.halves, strict=True):
        if isinstance(one, str):
            tall = min(frame.height - 16, LINE_HEIGHT * (2 + len(wrapped(one, TEXT, 2 * half - 16, 99))))
            put_reason(page, one, MARGIN + round(at - half), top + frame.height - 8 - tall, round(2 * half), tall)


def sturdy(plant: Plant, scale: float) -> Plant:
    """Return `plant` with a trunk that is seen at `scale` pixels a metre, or leaves of the young would float."""
    least = np.where(plant.level == 0, np.float32(_TRUNK / scale), np.float32(0))
    return replace(plant, radius=np.maximum(plant.radius, least))


def _alone(plant: Plant, frame: Frame) -> Frame:
    """Frame of a picture of the plant alone, with room for its shadow, and on the other side none of either."""
    extent = extent_of(plant)
    reach = max(-extent.left, extent.right) + _SHADOW * extent.height
    return Frame(frame.height, 2 * (int(reach * frame.scale) + 3), frame.scale)


def _landscape(drawn: Sequence[tuple[Picture, float]], frame: Frame) -> Picture:
    """Pictures (h, any, 3) in one, the trunk of each in its column: where they overlap, shadow falls on both."""
    if not drawn:
        return np.full((frame.height, frame.width, 3), BLANK, np.uint8)
    empty = np.maximum(drawn[0][0][:, :1].astype(np.float32), 1)  # sky and ground alone, the same in every picture
    whole = np.repeat(empty, frame.width, axis=1)
    for picture, trunk in drawn:
        left = round(trunk) - picture.shape[1] // 2
        first, last = max(left, 0), min(left + picture.shape[1], frame.width)
        whole[:, first:last] *= picture[:, first - left : last - left] / empty
    return np.asarray(np.minimum(whole + 0.5, 255), dtype=np.uint8)


def _put_ruler(draw: ImageDraw.ImageDraw, frame: Frame, top: int) -> None:
    """Ticks of whole steps of metres at the left edge."""
    ground, high = top + frame.base, (frame.base - NAME) / frame.scale
    step = next(size * ten for ten in 10.0 ** np.arange(-6, 7) for size in (1, 2, 5) if size * ten >= high / 5)
    for tick in range(1, int(high / step) + 1):
        y = round(ground - tick * step * frame.scale)
        draw.line((MARGIN + 1, y, MARGIN + 5, y), FAINT)
        draw.text((MARGIN + 9, y), f"{tick * step:g} m", FAINT, font(TEXT - 1), anchor="lm")
    draw.line((MARGIN, round(ground), MARGIN + 5, round(ground)), FAINT)


def _put_words(draw: ImageDraw.ImageDraw, moments: Sequence[Moment], row: Row, top: int) -> None:
    """Name and facts of each plant, centred under its trunk."""
    for moment, at, half in zip(moments, row.trunks, row.halves, strict=True):
        x, room = MARGIN + round(at), 2 * half
        draw.text((x, top), fitted(moment.name, NAME, room), INK, font(NAME), anchor="ma")
        for k, fact in enumerate(moment.facts):
            draw.text((x, top + NAME + 6 + k * LINE_HEIGHT), fitted(fact, TEXT, room), FAINT, font(TEXT), anchor="ma")
