"""score_curve.png: the score by evaluations and the stages of the search, drawn from history.jsonl alone."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from experiments.search_stages import labels_of, stages_of
from treefit.asset.pictures.font import font
from treefit.progress import Generation

BEST, IMAGE, MEAN = "#0072B2", "#D55E00", "#8a8a8a"
SHADES = ("#eef1f4", "#ffffff")
"""Bands of every other stage."""

BINS = 180
"""Equal parts of the search over each of which the means of batches are joined: single ones are a cloud."""

DIFFERENT = 0.004
"""How far image similarity and score are apart at least for both to be drawn."""

SIZE, DPI = (9.0, 5.0), 100
ROOM = 770
"""Pixels that the axis is long, about."""


def draw_score_curve(history: Sequence[Generation], title: str, path: Path) -> None:
    """Write the curve of a search to `path`; ValueError when there is no generation."""
    if not history:
        raise ValueError("score curve: the history has no generation")
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    look: dict[Any, Any] = {"font.size": 11, "axes.titlesize": 13, "axes.spines.top": False, "axes.spines.right": False}
    with rc_context(look):
        figure = Figure(figsize=SIZE, layout="constrained")
        axes = figure.subplots()
        _put_lines(axes, history)
        _put_stages(axes, history)
        axes.set_title(" ".join(title.split()), loc="left", parse_math=False, pad=26)
        axes.set(xlabel="evaluations", ylabel="score")
        axes.xaxis.set_major_formatter("{x:,.0f}")
        axes.grid(visible=True, axis="y", color="#d5d8dc", linewidth=0.8)
        figure.legend(loc="outside lower center", ncols=3, frameon=False)
        figure.savefig(path, dpi=DPI)


def _put_lines(axes: Any, history: Sequence[Generation]) -> None:
    evaluations = np.array([line.evaluations for line in history])
    best, image = np.array([line.best for line in history]), np.array([line.best_image for line in history])
    places, means = joined_means(history, BINS)
    axes.step(evaluations, best, where="post", color=BEST, linewidth=2.4, label="best so far", zorder=4)
    if np.abs(image - best).max() > DIFFERENT:
        axes.step(evaluations, image, where="post", color=IMAGE, linewidth=1.4, label="its image similarity", zorder=3)
    axes.plot(places, means, color=MEAN, linewidth=1.3, label="mean of what was tried", zorder=2)
    axes.annotate(f"{best[-1]:.3f}", (evaluations[-1], best[-1]), (6, 0), textcoords="offset points", color=BEST,
                  va="center", annotation_clip=False, fontweight="bold")  # fmt: skip
    low = min(float(np.quantile(means, 0.02)), float(best[0]))
    high = max(float(best[-1]), float(image.max()), low + 1e-3)
    axes.set(xlim=(0, evaluations[-1]), ylim=(max(low - 0.06 * (high - low), 0), high + 0.06 * (high - low)))


def joined_means(history: Sequence[Generation], parts: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Evaluations and mean score of what was tried in each of at most `parts` equal parts of the search."""
    evaluations = np.array([line.evaluations for line in history], float)
    sizes = np.diff(evaluations, prepend=0.0)
    part = np.minimum((evaluations / evaluations[-1] * parts).astype(int), parts - 1)
    weights = np.bincount(part, sizes)
    known = weights > 0
    means = np.bincount(part, sizes * np.array([line.mean for line in history]))[known] / weights[known]
    return np.bincount(part, sizes * evaluations)[known] / weights[known], means


def _put_stages(axes: Any, history: Sequence[Generation]) -> None:
    """Bands behind the lines, their names above them where these have room."""
    stages, whole = stages_of(history), history[-1].evaluations
    for i, stage in enumerate(stages):
        axes.axvspan(stage.first, stage.last, color=SHADES[i % 2], linewidth=0, zorder=0)
    for label in labels_of(stages):
        room = (label.last - label.first) / whole * ROOM + 12
        words = next((words for words in label.words if font(12.5).getlength(words) <= room), "")
        axes.text((label.first + label.last) / 2, 1.012, words, transform=axes.get_xaxis_transform(), ha="center",
                  va="bottom", fontsize=9, color="#666666", parse_math=False)  # fmt: skip
