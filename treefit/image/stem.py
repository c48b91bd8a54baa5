"""Stem of a photographed tree: the upright bar between two edges that leads from the ground into the crown."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from treefit.image.layout import Layout
from treefit.image.picture import Region
from treefit.image.sky import Lab

Field = NDArray[np.float64]
"""(h, k, w): a value for each row, bar width and column of the bar's middle."""

UPRIGHT_BLUR = 4.0
STRONGEST, THRESHOLD = 6.0, 1.5
LIGHT_GAIN, RED_GAIN = 0.9, 1.5
OFF_CENTRE, OFF_CENTRE_LOSS = 0.06, 12.0
BEND_LOSS, WIDENING_LOSS = 0.15, 0.6
WIDEST, WIDENING = 0.16, 1.9
LEAST_LENGTH, LEAST_STRENGTH = 0.04, 1.5
OTHER_COLOUR = 22.0
ADAPTION = 0.05
COLOUR_WEIGHTS = (0.3, 4.0, 1.0)
PATIENCE = 0.04
SKY_LOSS = -3.0


@dataclass(frozen=True)
class _Bar:
    row: int
    middle: int
    width: int
    strength: float


def find_stem(lab: Lab, sky: Region, layout: Layout) -> Region:
    """(h, w) bool: pixels of the stem, from its foot up to where its colour is lost; empty when there is none."""
    height, width = sky.shape
    stem = np.zeros_like(sky)
    widths = _widths(width)
    if height < 16 or not widths:
        return stem
    bars = _climb(lab, _best_path(_strengths(lab, sky, layout, widths), widths, layout))
    foot = bars[: int(0.12 * height) + 1]
    if len(bars) < LEAST_LENGTH * height or np.mean([bar.strength for bar in foot]) < LEAST_STRENGTH:
        return stem
    for bar in bars:
        left = max(0, bar.middle - bar.width // 2)
        stem[bar.row, left : left + bar.width] = True
    return stem


def _widths(width: int) -> list[int]:
    """Bar widths to try in pixels, each about a third wider than the last."""
    return [wide for wide in sorted({max(3, round(2.5 * 1.35**step)) for step in range(12)}) if wide < WIDEST * width]


def _strengths(lab: Lab, sky: Region, layout: Layout, widths: list[int]) -> Field:
    """How much a bar stands out: the weaker of its two edges (dark, light or reddish bars), over a threshold."""
    soft = ndimage.gaussian_filter1d(lab[..., :2], UPRIGHT_BLUR, axis=0)
    edges = ndimage.gaussian_filter1d(soft, 1.0, axis=1, order=1)
    strengths = np.stack([_edge_pair(edges, wide) for wide in widths], axis=1)
    columns = (np.arange(sky.shape[1]) + 0.5) / sky.shape[1]
    aside = np.maximum(np.abs(columns - layout.centre) - OFF_CENTRE, 0)
    strengths += -THRESHOLD - OFF_CENTRE_LOSS * aside
    return np.where(sky[:, None, :], SKY_LOSS, strengths)


def _edge_pair(edges: Lab, wide: int) -> NDArray[np.float64]:
    """(h, w) strength of a bar `wide` pixels wide around each pixel, at most STRONGEST."""
    left, right = np.roll(edges, wide // 2, axis=1), np.roll(edges, wide // 2 - wide, axis=1)
    dark = np.minimum(-left[..., 0], right[..., 0])
    light = LIGHT_GAIN * np.minimum(left[..., 0], -right[..., 0])
    red = RED_GAIN * np.minimum(left[..., 1], -right[..., 1])
    strength = np.clip(np.maximum(np.maximum(dark, light), red), -1, STRONGEST)
    strength[:, : wide // 2] = strength[:, -wide:] = -STRONGEST
    return np.asarray(strength)


def _best_path(strengths: Field, widths: list[int], layout: Layout) -> list[_Bar]:
    """Bars from foot to top of the path with the largest sum; the path may bend and widen a little from row to row."""
    total, step = np.zeros_like(strengths), np.full(strengths.shape, -1, dtype=np.int8)
    losses = [(k, x, BEND_LOSS * abs(x) + WIDENING_LOSS * abs(k)) for k in (-1, 0, 1) for x in (-1, 0, 1)]
    _, n_widths, n_columns = strengths.shape
    for row in range(1, len(strengths)):
        above = np.pad(total[row - 1], 1, constant_values=-1.0)
        reached = np.stack([above[1 + k : 1 + k + n_widths, 1 + x : 1 + x + n_columns] - loss for k, x, loss in losses])
        best = reached.max(axis=0)
        step[row] = np.where(best > 0, reached.argmax(axis=0), -1)
        total[row] = np.maximum(np.maximum(best, 0) + strengths[row], 0)
    ends = total.copy()
    ends[: int(max(layout.horizon, 0.55) * len(ends))] = 0
    row, wide, column = (int(index) for index in np.unravel_index(ends.argmax(), ends.shape))
    path: list[_Bar] = []
    while row > 0 and total[row, wide, column] > 0:
        path.append(_Bar(row, column, widths[wide], float(strengths[row, wide, column])))
        if step[row, wide, column] < 0:
            break
        k, x, _ = losses[step[row, wide, column]]
        row, wide, column = row - 1, wide + k, column + x
    return path


def _climb(lab: Lab, path: list[_Bar]) -> list[_Bar]:
    """The part of `path` from its foot to where colour or width change for good: there the foliage begins."""
    if not path:
        return path
    colours = np.array([_colour(lab, bar) for bar in path])
    height = len(lab)
    typical = np.median(colours[: max(5, int(0.08 * height))], axis=0)
    widest = WIDENING * float(np.median([bar.width for bar in path[: int(0.1 * height) + 1]])) + 1
    strange = 0
    for index, (bar, colour) in enumerate(zip(path, colours, strict=True)):
        # lightness counts less, the stem goes through sun and shade; green against red counts most
        if np.sqrt(((colour - typical) ** 2 * COLOUR_WEIGHTS).sum()) < OTHER_COLOUR and bar.width < widest:
            typical, strange = (1 - ADAPTION) * typical + ADAPTION * colour, 0
            continue
        strange += 1
        if strange > PATIENCE * height:
            return path[: index - strange + 1]
    return path


def _colour(lab: Lab, bar: _Bar) -> NDArray[np.float64]:
    reach = bar.width // 3
    return np.asarray(np.median(lab[bar.row, max(0, bar.middle - reach) : bar.middle + reach + 1], axis=0))
