"""Plot of the task speed_study: milliseconds by size of the tree and by rows of the mask, both axes logarithmic."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from experiments.speed_page import GENERATE, OURS, Point

STYLES = (("#E69F00", "s"), ("#009E73", "^"), ("#CC79A7", "D"), ("#D55E00", "v"))
"""Colours that colour-blind people tell apart (Okabe and Ito), each with a marker of its own."""

PROMINENT = {OURS: {"color": "#0072B2", "marker": "o", "linewidth": 3, "markersize": 8},
             GENERATE: {"color": "#555555", "linestyle": "--", "linewidth": 1.5}}  # fmt: skip


def draw_speed(by_size: Sequence[Point], by_rows: Sequence[Point], path: Path) -> None:
    """Write the plot to `path`."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    with rc_context({"font.size": 12, "axes.titlesize": 12, "axes.spines.top": False, "axes.spines.right": False}):
        figure = Figure(figsize=(10, 5), layout="constrained")
        left, right = figure.subplots(1, 2, sharey=True, width_ratios=[3, 2])
        _lines(left, [point.vertices for point in by_size], by_size)
        _lines(right, [point.rows for point in by_rows], by_rows)
        left.set(xlabel="vertices of the tree (leaves: twice as many)", ylabel="milliseconds a tree")
        left.set_title(f"masks of {by_size[0].rows} rows")
        right.set(xlabel="rows of the mask")
        right.set_title(f"trees of about {by_rows[0].vertices / 1000:.0f}k vertices")
        figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=3, frameon=False)
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=120)


def _lines(axes: Any, places: Sequence[int], points: Sequence[Point]) -> None:
    """Draw a line for every name, with ticks at the `places` that were measured; 1k is 1,000."""
    from matplotlib.ticker import FuncFormatter, NullLocator

    styles = iter(STYLES)
    for name in points[0].ms:
        style = PROMINENT.get(name) or dict(zip(("color", "marker"), next(styles), strict=True))
        axes.plot(places, [point.ms[name] for point in points], label=name, **style)
    axes.set(xscale="log", yscale="log")
    axes.grid(visible=True, which="major", color="#dddddd", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.set_xticks(places, [f"{place / 1000:.0f}k" if place >= 950 else str(place) for place in places])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
