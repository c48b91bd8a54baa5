"""Growth as a moving picture: one camera and one ground, a picture a year, and time to look at the end."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path

from PIL import Image, ImageDraw

from experiments.errors import one_line
from experiments.sheet_paper import NAME, TEXT_INK
from experiments.strip_page import Moment, scale_of, sturdy
from treefit.asset import AssetSettings, picture
from treefit.asset.pictures.font import font
from treefit.asset.pictures.frame import Frame
from treefit.plant import Plant
from treefit.plant.extent import extent_of

STEP, SLOWEST, PAUSE = 140, 380, 2600
"""Milliseconds of a picture, of those before the last, and of the last."""

_log = logging.getLogger(__name__)

_SIDE = 0.09  # room beside the plant by the height of the picture


def write_animation(file: Path, moments: Sequence[Moment], asset: AssetSettings) -> bool:
    """Write the plants of `moments` as an animated WebP; False when there is none to show."""
    shown = [(moment, moment.plant) for moment in moments if isinstance(moment.plant, Plant)]
    if not shown:
        return False
    frame = _frame([plant for _, plant in shown], 2 * round(asset.picture_size / 2))
    drawn = (_picture(moment, plant, frame, asset) for moment, plant in shown)
    pictures = [image for image in drawn if image is not None]
    if not pictures:
        return False
    pictures[0].save(
        file, save_all=True, append_images=pictures[1:], duration=durations(len(pictures)), loop=0, quality=86, method=4
    )
    return True


def durations(count: int) -> list[int]:
    """Milliseconds of each picture: the growth slows down to its end, which stays."""
    ease = [max(0.0, 1 - (count - 2 - i) / 4) ** 2 for i in range(count - 1)]
    return [*(round(STEP + (SLOWEST - STEP) * share) for share in ease), PAUSE]


def _frame(plants: Sequence[Plant], height: int) -> Frame:
    """Camera that every plant has room before."""
    extents = [extent_of(plant) for plant in plants]
    reach = max(max(-extent.left, extent.right) for extent in extents)
    scale = scale_of(extents, height, 2.5 * height)
    return Frame(height, 2 * round(max(reach * scale + _SIDE * height, 0.4 * height)), scale)


def _picture(moment: Moment, plant: Plant, frame: Frame, asset: AssetSettings) -> Image.Image | None:
    """Picture of the plant with its name; None when it cannot be drawn, for a year less is no end."""
    try:
        image = Image.fromarray(picture(sturdy(plant, frame.scale), asset, frame))
    except Exception as error:
        _log.warning("growth.webp is without %s: %s", moment.name, one_line(error))
        return None
    draw = ImageDraw.Draw(image)
    draw.text((14, 12), moment.name, TEXT_INK, font(NAME + 3))
    return image
