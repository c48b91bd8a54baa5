"""Plots of the task compare: score by evaluations, and how far behind the best of the optimisers."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from experiments.compare_statistics import Group, differences

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#E69F00", "#56B4E9", "#8C6D31")
"""Colours that colour-blind people tell apart (Okabe and Ito; their yellow is too faint for a line)."""

DASHES = ("-", "--", "-.", ":")
POINTS = 120
LEAST, LATE = 100, 1_000
"""Evaluations at the left edge (of short searches a tenth of theirs), and from where on all lines are seen whole."""


def draw_curves(groups: Sequence[Group], evaluations: int, path: Path, *, behind: bool = False) -> None:
    """Write the mean score by evaluations to `path`; a panel a group.

    With `behind` it is the difference to the best mean after as many evaluations. The band of an optimiser is the
    standard error of its paired difference to the first.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    names = list(dict.fromkeys(name for group in groups for name in group.optimizers))
    with rc_context({"font.size": 12, "axes.titlesize": 13, "axes.spines.top": False, "axes.spines.right": False}):
        figure = Figure(figsize=(max(5.2 * len(groups), 8), 5.4), layout="constrained")
        panels = figure.subplots(1, len(groups), squeeze=False)[0]
        for axes, group in zip(panels, groups, strict=True):
            _panel(axes, group, names, evaluations, behind)
        panels[0].set_ylabel("mean score behind the best" if behind else "mean score of the best plant so far")
        shown = {label: line for axes in panels for line, label in zip(*axes.get_legend_handles_labels(), strict=True)}
        figure.legend(shown.values(), shown.keys(), loc="outside lower center", ncols=min(len(shown), 5), frameon=False)
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=120)


def _panel(axes: Any, group: Group, names: Sequence[str], evaluations: int, behind: bool) -> None:
    places = np.unique(np.geomspace(min(LEAST, max(evaluations // 10, 1)), evaluations, POINTS).astype(int))
    scores = [group.at(place) for place in places]
    mean = np.array([one.mean(axis=1) for one in scores]).T
    error = np.nan_to_num(np.array([differences(one)[1] for one in scores]).T)
    mean = mean - mean.max(axis=0) if behind else mean
    for i, name in enumerate(group.optimizers):
        k = names.index(name)
        style = {"color": COLOURS[k % len(COLOURS)], "linestyle": DASHES[(k // len(COLOURS) + k) % len(DASHES)]}
        axes.plot(places, mean[i], label=name, linewidth=2.2, zorder=3 if i == 0 else 2, **style)
        axes.fill_between(places, mean[i] - error[i], mean[i] + error[i], color=style["color"], alpha=0.15, linewidth=0)
    axes.set(xscale="log", xlabel="evaluations", xlim=(places[0], places[-1]), title=group.name)
    late = places >= (LATE if evaluations > 2 * LATE else 0)  # before it, lines would squeeze what one looks for
    low, high = float((mean - error)[:, late].min()), float((mean + error).max())
    axes.set_ylim(low - 0.03 * (high - low) - 1e-4, high + 0.03 * (high - low) + 1e-4)
    axes.grid(visible=True, which="major", color="#dddddd", linewidth=0.8)
    axes.set_axisbelow(True)
    _ticks(axes, evaluations)


def _ticks(axes: Any, evaluations: int) -> None:
    from matplotlib.ticker import NullLocator

    shown = [place for place in (100, 250, 500, 1_000, 2_500, 5_000, 10_000, 25_000, 50_000, 100_000, 200_000)
             if place <= evaluations]  # fmt: skip
    axes.set_xticks(shown, [f"{place / 1000:g}k" if place >= 1000 else str(place) for place in shown])
    axes.xaxis.set_minor_locator(NullLocator())
