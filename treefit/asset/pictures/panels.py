"""Panels: pictures and masks cut so that all trees stand at one height on one baseline, to be set side by side."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFilter

from treefit.asset.pictures.frame import BASE_SHARE, TREE_SHARE
from treefit.mask import PALETTE, Mask

Picture = NDArray[np.uint8]  # (h, w, 3) sRGB

NARROWEST, WIDEST = 0.6, 1.6  # widths of panels in their heights
_ROUND = 7  # pixels of a corner's radius
_SMOOTH = 4  # times as large as it is shown the shape of a corner is drawn


@dataclass(frozen=True, eq=False)
class Panels:
    """Picture and mask of one tree in panels of one size; its trunk stands in column `middle`."""

    picture: Image.Image
    mask: Image.Image
    middle: float

    @property
    def width(self) -> int:
        """Pixels."""
        return self.picture.width

    def widened(self, width: int) -> Panels:
        """Return panels `width` pixels wide: cut on both sides alike, or with their edge columns repeated."""
        shift = (width - self.width) // 2
        return Panels(_cut_to(self.picture, width), _cut_to(self.mask, width), self.middle + shift)


@dataclass(frozen=True)
class _Tree:
    """Where a tree stands in an image, in pixels of that image."""

    base: float  # row of the lowest part
    middle: float  # column of the trunk base
    tall: float


def given_panels(picture_rgb: Picture, mask: Mask, height: int) -> Panels:
    """Return panels of a user's picture, as wide as it is at that scale, and of its mask; they may differ in size."""
    tree = _tree_in(mask)
    down, across = picture_rgb.shape[0] / mask.shape[0], picture_rgb.shape[1] / mask.shape[1]
    in_picture = _Tree(tree.base * down, tree.middle * across, tree.tall * down)
    scale = TREE_SHARE * height / in_picture.tall
    left, right = (scale * (column - in_picture.middle) for column in (0, picture_rgb.shape[1]))
    limit = height * WIDEST / 2
    span = (max(left, -limit), max(min(right, limit), max(left, -limit) + height * NARROWEST))
    upper = _stand(Image.fromarray(picture_rgb), in_picture, span, height, Image.Resampling.LANCZOS)
    return Panels(upper, _stand(_coloured(mask), tree, span, height, Image.Resampling.BOX), -span[0])


def drawn_panels(picture: Picture, mask: Mask, height: int) -> Panels:
    """Return panels of a picture that was drawn in a Frame, and of the plant's mask."""
    image = Image.fromarray(picture)
    width = round(min(max(image.width / image.height, NARROWEST), WIDEST) * height)
    upper = image.resize((max(1, round(image.width * height / image.height)), height), Image.Resampling.LANCZOS)
    lower = _stand(_coloured(mask), _tree_in(mask), (-width / 2, width / 2), height, Image.Resampling.BOX)
    return Panels(_cut_to(upper, width), lower, width / 2)


def paste_rounded(page: Image.Image, panel: Image.Image, place: tuple[int, int]) -> None:
    """Put `panel` on `page` with its corners rounded."""
    large = Image.new("L", (panel.width * _SMOOTH, panel.height * _SMOOTH))
    box = (0, 0, large.width - 1, large.height - 1)
    ImageDraw.Draw(large).rounded_rectangle(box, _ROUND * _SMOOTH, fill=255)
    page.paste(panel, place, large.resize(panel.size, Image.Resampling.BOX))


def _coloured(mask: Mask) -> Image.Image:
    return Image.fromarray(np.array(PALETTE, dtype=np.uint8)[mask])


def _stand(
    image: Image.Image, tree: _Tree, span: tuple[float, float], height: int, how: Image.Resampling
) -> Image.Image:
    """Panel with the tree of `image` at the common height and baseline; `span`: its edges from the trunk, in pixels.

    Beyond a mask it is white; beyond a picture, the picture's own edge is mirrored out of focus.
    """
    scale = TREE_SHARE * height / tree.tall
    left, top = tree.middle + span[0] / scale, tree.base - BASE_SHARE * height / scale
    width = round(span[1] - span[0])
    inside = (
        max(left, 0),
        max(top, 0),
        min(left + width / scale, image.width),
        min(top + height / scale, image.height),
    )
    panel = Image.new("RGB", (width, height), PALETTE[0])
    if inside[0] >= inside[2] or inside[1] >= inside[3]:
        return panel
    corner = round((inside[0] - left) * scale), round((inside[1] - top) * scale)
    size = max(round((inside[2] - inside[0]) * scale), 1), max(round((inside[3] - inside[1]) * scale), 1)
    shown = image.resize(size, how, box=inside)
    if how is not Image.Resampling.BOX:
        panel = _mirrored(shown, corner, panel.size)
    panel.paste(shown, corner)
    return panel


def _mirrored(image: Image.Image, corner: tuple[int, int], size: tuple[int, int]) -> Image.Image:
    """Image of `size` that is `image`, its upper left at `corner`, and its mirror images around it, blurred."""
    across, down = (
        (max(before, 0), max(whole - before - part, 0))
        for before, part, whole in zip(corner, image.size, size, strict=True)
    )
    padded = np.pad(np.asarray(image), (down, across, (0, 0)), mode="symmetric")
    around = Image.fromarray(padded[: size[1], : size[0]])
    return around.filter(ImageFilter.GaussianBlur(0.012 * size[1]))


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
