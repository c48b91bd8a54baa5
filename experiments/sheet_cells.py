"""Cells of a sheet: plants that stand beside each other as pictures and masks, all at one scale on one baseline."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from experiments.errors import one_line
from treefit.asset import AssetSettings, picture
from treefit.asset.pictures.frame import TREE_SHARE, Frame
from treefit.mask import PALETTE
from treefit.plant import Budget, Generator, Plant, Values, check_plant
from treefit.plant.extent import Extent, extent_of
from treefit.view import Frame as Window
from treefit.view import OrthographicView

BUDGET = Budget(vertices=500_000, leaves=1_000_000)
"""Of a single plant that is grown to be looked at."""

WIDTH = 1.06  # of a cell by its height
_SIDE_ROOM = 0.05  # of a cell's height, left and right of the widest plant
_MASK_ROWS, _MOST_WORDS = 256, 128
_FINER = 2
THREADS = 2  # more wait for each other

Picture = NDArray[np.uint8]  # (h, w, 3) sRGB


@dataclass(frozen=True, eq=False)
class Cell:
    """One plant as a picture and as a mask, either None when it is not wanted; or the reason why there is none."""

    shaded: Picture | None = None
    mask: Picture | None = None
    failure: str = ""

    def looks_like(self, other: Cell) -> bool:
        """Whether both show the same pixels."""
        pairs = ((self.shaded, other.shaded), (self.mask, other.mask))
        return all(one is two or (one is not None and two is not None and np.array_equal(one, two))
                   for one, two in pairs)  # fmt: skip


@dataclass(frozen=True)
class Drawing:
    """How cells are drawn: `look` is shaded, mask or both; `height` in pixels of a picture, `mask_height` of a mask."""

    asset: AssetSettings
    look: str
    height: int
    mask_height: int

    @property
    def sizes(self) -> tuple[tuple[int, int], ...]:
        """Height and width of the panels of a cell in pixels: of the picture, of the mask."""
        heights = {"shaded": (self.height,), "mask": (self.mask_height,)}.get(
            self.look, (self.height, self.mask_height)
        )
        return tuple((height, _width(height)) for height in heights)

    def row(self, plants: Sequence[Plant | str]) -> list[Cell]:
        """Cells of `plants` at one scale; a text instead of a plant is the reason why there is none."""
        extents = [extent_of(plant) for plant in plants if isinstance(plant, Plant)]
        scale = _scale(extents) if extents else 1.0
        drawn = [next(j for j in range(i + 1) if same(plants[j], plant)) for i, plant in enumerate(plants)]
        alone = sorted(set(drawn))
        with ThreadPoolExecutor(THREADS) as pool:
            cells = dict(zip(alone, pool.map(lambda i: self._cell(plants[i], scale), alone), strict=True))
        return [cells[i] for i in drawn]

    def _cell(self, plant: Plant | str, scale: float) -> Cell:
        if isinstance(plant, str):
            return Cell(failure=plant)
        shaded = mask = None
        try:
            if self.look != "mask":
                shaded = shaded_panel(plant, self.asset, _frame(self.height, scale))
            if self.look != "shaded":
                mask = mask_panel(plant, _frame(self.mask_height, scale))
        except Exception as error:
            return Cell(failure=f"not drawn: {one_line(error)}")
        return Cell(shaded, mask)


def grow(generator: Generator, values: Values, seed: int, budget: Budget = BUDGET) -> Plant | str:
    """Plant of `values`, or the reason why there is none: whatever a generator does, the sheet goes on."""
    try:
        plant = generator(values, seed, budget)
        check_plant(plant)
    except Exception as error:
        return one_line(error)
    if plant.cut:
        return f"cut at {plant.n_vertices:,} vertices and {plant.n_leaves:,} leaves"
    return plant


def same(one: Plant | str, two: Plant | str) -> bool:
    """Whether both are the same plant to the bit, as where a parameter has no say."""
    if isinstance(one, str) or isinstance(two, str):
        return one == two
    return all(np.array_equal(getattr(one, field.name), getattr(two, field.name)) for field in fields(Plant))


def _scale(extents: Sequence[Extent]) -> float:
    """Cell heights a metre at which all plants fit into their cells."""
    tall = max(extent.height for extent in extents)
    reach = max(max(-extent.left, extent.right) for extent in extents)
    return min(TREE_SHARE / max(tall, 1e-6), (WIDTH / 2 - _SIDE_ROOM) / max(reach, 1e-6))


def _frame(height: int, scale: float) -> Frame:
    return Frame(height, _width(height), scale * height)


def _width(height: int) -> int:
    return 2 * round(height * WIDTH / 2)


def shaded_panel(plant: Plant, asset: AssetSettings, frame: Frame) -> Picture:
    """Picture of `plant`, drawn larger than it is shown: twigs as wide as a small pixel would hide the leaves."""
    large = Image.fromarray(picture(plant, asset, frame.finer(_FINER)))
    return np.asarray(large.resize((frame.width, frame.height), Image.Resampling.BOX), dtype=np.uint8)


def mask_panel(plant: Plant, frame: Frame) -> Picture:
    """Mask of `plant` in its colours where the picture has the plant: at the frame's scale, on its baseline."""
    extent = extent_of(plant)
    reach = max(-extent.left, extent.right) / max(extent.height, 1e-6)
    window = Window(_MASK_ROWS, min(max(1, int(np.ceil(2 * reach * _MASK_ROWS / 64))), _MOST_WORDS))
    mask = OrthographicView(resolution=_MASK_ROWS)(plant, window).unpack()
    shown = Image.fromarray(np.array(PALETTE, np.uint8)[mask])
    tall = max(round(extent.height * frame.scale), 1)
    wide = max(round(window.width * tall / window.height), 1)
    panel = Image.new("RGB", (frame.width, frame.height), PALETTE[0])
    at = round(frame.width / 2 - wide / 2), round(frame.base) - tall
    panel.paste(shown.resize((wide, tall), Image.Resampling.BOX), at)
    return np.asarray(panel, dtype=np.uint8)
