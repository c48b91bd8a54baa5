"""Plots of the task statistics: V by parameter, marks as a heat map, and how well marks foretell good plants."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from treefit.family.calibration import Calibration
from treefit.family.statistics import Mark, Statistics

COLOURS = {"continuous": "#0072B2", "paper": "#E69F00"}
FONT: dict[Any, Any] = {"font.size": 10, "axes.titlesize": 11, "axes.spines.top": False, "axes.spines.right": False}
ROW = 0.2
"""Inches that a parameter has."""


def draw_rate(statistics: Statistics, path: Path) -> None:
    """Write V(k) by parameter, the liveliest on top, to `path`."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    order = np.argsort(statistics.rate)
    with rc_context(FONT):
        figure = Figure(figsize=(8, 1.2 + ROW * len(order)), layout="constrained")
        axes = figure.subplots()
        axes.barh([statistics.names[i] for i in order], statistics.rate[order], color=COLOURS["continuous"])
        axes.margins(y=0.01)
        title = f"{statistics.generator} {statistics.version}: V by parameter, from {statistics.steps[0]:,} good plants"
        axes.set(xlabel="V: mean change of the score by that of the gene", title=title)
        axes.grid(visible=True, axis="x", color="#dddddd", linewidth=0.8)
        axes.set_axisbelow(True)
        figure.savefig(path, dpi=110)


def draw_marks(statistics: Statistics, path: Path, mark: Mark = "continuous") -> None:
    """Write the marks Q(i, j) as a heat map to `path`, parameters with the strongest on top."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    quality = statistics.quality(mark)
    order = np.argsort(-np.abs(quality).max(axis=1))
    n, k = quality.shape
    most = max(0.2, float(np.quantile(np.abs(quality), 0.98)))
    with rc_context(FONT):
        figure = Figure(figsize=(8, 1.6 + ROW * n), layout="constrained")
        axes = figure.subplots()
        image = axes.imshow(quality[order], cmap="RdBu", vmin=-most, vmax=most, aspect="auto", interpolation="nearest")
        axes.set_yticks(range(n), [statistics.names[i] for i in order])
        axes.set_xticks(np.linspace(-0.5, k - 0.5, 6), [f"{x:g}" for x in np.linspace(0, 1, 6)])
        title = (
            f"{statistics.generator} {statistics.version}: marks Q(i, j), from {statistics.evaluations:,} evaluations"
        )
        axes.set(xlabel="gene, from its lowest to its highest value", title=title)
        bar = figure.colorbar(image, ax=axes, extend="both", shrink=min(1.0, 10 / n + 0.3))
        bar.set_label("worse than the mean   |   better than the mean")
        figure.savefig(path, dpi=110)


def draw_calibration(statistics: Statistics, found: Mapping[Mark, Calibration], path: Path) -> None:
    """Write P(f > eps) by Q(G) on fresh plants, with the evaluations behind it, for either form of the mark."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure
    from matplotlib.ticker import NullFormatter

    with rc_context(FONT):
        figure = Figure(figsize=(8, 5.5), layout="constrained")
        axes = figure.subplots(2, len(found), sharex="col", sharey="row", height_ratios=[3, 1], squeeze=False)
        for (mark, calibration), (upper, lower) in zip(found.items(), axes.T, strict=True):
            width = max(float(np.ptp(calibration.marks)) / 16, 1e-6)
            middle, chance, counts = calibration.curve(width)
            upper.plot(middle, chance, marker="o", color=COLOURS[mark])
            upper.axhline(statistics.p0, color="#888888", linestyle="--", linewidth=1)
            upper.set_title(f"{mark} marks: rank correlation {calibration.rank_correlation:.2f}")
            upper.set_ylim(bottom=0)
            lower.bar(middle, counts, width=0.9 * width, color="#bbbbbb")
            lower.set(yscale="log", xlabel="Q(G), sum of the marks of a plant")
            lower.yaxis.set_minor_formatter(NullFormatter())
        axes[0, 0].set_ylabel("P(f > eps); dashed: P0")
        axes[1, 0].set_ylabel("evaluations")
        plants = len(next(iter(found.values())).marks)
        title = f"{statistics.generator} {statistics.version}: how marks foretell good plants, on {plants:,} fresh ones"
        figure.suptitle(title, fontsize=12)
        figure.savefig(path, dpi=110)
