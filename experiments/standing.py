"""Panels of one size in which trees stand at one height on one baseline: the given picture, and plants, with masks."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from experiments.sheet_cells import mask_panel
from treefit.asset import AssetSettings, TreeColours, picture
from treefit.asset.pictures.frame import BASE_SHARE, TREE_SHARE, Frame
from treefit.mask import PALETTE, Mask
from treefit.placing import place
from treefit.plant import Plant
from treefit.plant.extent import Extent, extent_of

Picture = NDArray[np.uint8]  # (h, w, 3) sRGB
Panels = tuple[Picture, Picture]  # the picture and the mask

_PAPER = (255, 255, 255)
_NARROW, _WIDE, _SIDE = 0.62, 1.5, 0.05  # widths of panels in their heights, and the room beside a plant


def ratio_for(reach: float) -> float:
    """Width of a panel in its heights, for a tree that reaches so many of its heights to the side."""
    return min(max(2 * (TREE_SHARE * reach + _SIDE), _NARROW), _WIDE)


def reach_of(extent: Extent) -> float:
    """How far a plant reaches to the side, in its heights."""
    return max(-extent.left, extent.right) / max(extent.height, 1e-6)


def drawn_panels(
    plant: Plant, asset: AssetSettings, height: int, width: int, seen: TreeColours | None = None
) -> Panels:
    """Picture and mask of `plant` (height, width, 3), trunk base in the middle; smaller where it is too wide."""
    extent = extent_of(plant)
    room = (width / 2 - _SIDE * height) / max(reach_of(extent), 1e-6)
    frame = Frame(height, width, min(TREE_SHARE * height, room) / max(extent.height, 1e-6))
    return picture(plant, asset, frame, seen), mask_panel(plant, frame)


def given_panels(rgb: Picture, mask: Mask, height: int, width: int) -> Panels:
    """The given picture and its mask likewise; both show the same frame, whatever their sizes."""
    tree = place(mask)
    scale = TREE_SHARE * height / (tree.bottom - tree.top)  # pixels of the panel by those of the mask
    left, top = tree.base - width / 2 / scale, tree.bottom - BASE_SHARE * height / scale
    coloured = Image.fromarray(np.array(PALETTE, np.uint8)[mask])

    def panel(image: Image.Image, how: Image.Resampling) -> Picture:
        across, down = image.width / mask.shape[1], image.height / mask.shape[0]
        first, last = max(left, 0.0), min(left + width / scale, float(mask.shape[1]))
        upper, lower = max(top, 0.0), min(top + height / scale, float(mask.shape[0]))
        size = max(round((last - first) * scale), 1), max(round((lower - upper) * scale), 1)
        box = (first * across, upper * down, last * across, lower * down)
        whole = Image.new("RGB", (width, height), _PAPER)
        whole.paste(image.resize(size, how, box=box), (round((first - left) * scale), round((upper - top) * scale)))
        return np.asarray(whole, dtype=np.uint8)

    return panel(Image.fromarray(rgb), Image.Resampling.LANCZOS), panel(coloured, Image.Resampling.BOX)
