"""best_strip.png: how the best plant of a search changed, beside the picture that it was to look like."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from experiments.errors import one_line
from experiments.sheet_cells import THREADS, grow
from experiments.sheet_paper import FAINT, GAP, INK, LINE_HEIGHT, MARGIN, NAME, TEXT, new_page, put_panel, put_reason
from experiments.standing import Panels, Picture, drawn_panels, given_panels, ratio_for, reach_of
from treefit.asset import AssetSettings, TreeColours
from treefit.asset.pictures.font import font
from treefit.fit import Result
from treefit.improvements import Improvement
from treefit.plant import Plant
from treefit.plant.extent import Extent, extent_of

MOST = 8
"""Plants of a strip."""

WIDEST, HIGHEST, LOWEST = 1760, 260, 150
"""Pixels of the page without its margins, and the limits of a panel's height."""


def write_best_strip(
    path: Path, result: Result, rgb: Picture, asset: AssetSettings, title: str, seen: TreeColours | None = None
) -> None:
    """Write the strip of `result`; `rgb` (h, w, 3) is the picture that its target was found in."""
    grown = [(one, _plant(result, one)) for one in spread(result.improvements, MOST)]
    known = [(one, plant) for one, plant in grown if isinstance(plant, Plant)]  # a foreign program may fail now
    shown, plants = [one for one, _ in known], [plant for _, plant in known]
    extents = [extent_of(plant) for plant in plants]
    height, width = _panel_size(extents, len(shown) + 1)
    with ThreadPoolExecutor(THREADS) as pool:
        drawn = list(pool.map(lambda plant: _panels(plant, asset, height, width, seen), plants))
    columns: list[Panels | str] = [given_panels(rgb, result.target, height, width), *drawn]
    words = [
        ("the picture", "and its mask"),
        *((f"after {one.evaluations:,}", f"score {one.score:.3f}") for one in shown),
    ]
    legend = f"The best plant so far, in a search of {result.evaluations:,} evaluations, all at one height."
    _page(columns, words, (height, width), title, legend).save(path)


def spread(improvements: Sequence[Improvement], most: int) -> list[Improvement]:
    """At most `most` of `improvements`: the best plants at evenly spread logarithms of evaluations, and the last."""
    if len(improvements) <= most:
        return list(improvements)
    evaluations = np.array([one.evaluations for one in improvements])
    chosen = np.array([0, len(improvements) - 1])
    for count in range(most, 20 * most):  # several places may fall between the same two improvements
        places = np.geomspace(evaluations[0], evaluations[-1], count).round()
        known = np.unique(np.searchsorted(evaluations, places, side="right") - 1)
        if len(known) > most:
            break
        chosen = known
    return [improvements[i] for i in chosen]


def _plant(result: Result, improvement: Improvement) -> Plant | str:
    objective = result.objective
    values = objective.space.decode(np.array(improvement.genome))
    return grow(objective.generator, values, objective.seed, objective.budget)


def _panel_size(extents: Sequence[Extent], columns: int) -> tuple[int, int]:
    """Height and width of a panel, so that the widest plant has room and the page is not too wide."""
    ratio = ratio_for(max((reach_of(extent) for extent in extents), default=0.5))
    height = min(max((WIDEST - (columns - 1) * GAP) / columns / ratio, LOWEST), HIGHEST)
    return round(height), 2 * round(height * ratio / 2)


def _panels(plant: Plant, asset: AssetSettings, height: int, width: int, seen: TreeColours | None) -> Panels | str:
    try:
        return drawn_panels(plant, asset, height, width, seen)
    except Exception as error:
        return f"not drawn: {one_line(error)}"


def _page(
    columns: Sequence[Panels | str], words: Sequence[tuple[str, str]], size: tuple[int, int], title: str, legend: str
) -> Image.Image:
    height, width = size
    whole = len(columns) * (width + GAP) - GAP
    page, top = new_page(whole + 2 * MARGIN, 2 * (height + GAP) + NAME + LINE_HEIGHT + 4, title, legend)
    draw, left = ImageDraw.Draw(page), MARGIN
    for panels, (name, fact) in zip(columns, words, strict=True):
        for i in range(2):
            place = left, top + i * (height + GAP)
            if isinstance(panels, str):
                put_reason(page, panels, *place, width, height)
            else:
                put_panel(page, panels[i], *place)
        below = top + 2 * (height + GAP)
        draw.text((left + 1, below), name, INK, font(NAME))
        draw.text((left + 1, below + NAME + 5), fact, FAINT, font(TEXT))
        left += width + GAP
    return page
