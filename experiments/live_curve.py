"""Curve of a search that is going on, as SVG for live.html: what score_curve.png shows, drawn in a few milliseconds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import NDArray

from experiments.score_curve import DIFFERENT, joined_means
from experiments.search_stages import labels_of, stages_of
from treefit.asset.pictures.font import font
from treefit.progress import Generation

WIDTH, HEIGHT = 760, 360
LEFT, RIGHT, TOP, BOTTOM = 44, 752, 24, 332
"""Edges of the plot."""

PARTS, LETTERS = 120, 12


def curve_svg(history: Sequence[Generation], evaluations: int) -> str:
    """SVG of `history`, one generation or more, along an axis of all `evaluations` that the search may take."""
    done = np.array([line.evaluations for line in history], float)
    best, image = np.array([line.best for line in history]), np.array([line.best_image for line in history])
    places, means = joined_means(history, PARTS)
    low = min(float(np.quantile(means, 0.05)), float(best[0]))
    high = max(float(best[-1]), float(image.max()), low + 0.02)
    room = 0.05 * (high - low)
    plot = _Plot(max(low - room, 0.0), high + room, max(float(evaluations), float(done[-1])))
    lines = [plot.line("mean", zip(places, means, strict=True))]
    if np.abs(image - best).max() > DIFFERENT:
        lines.append(plot.line("image", _steps(done, image)))
    lines.append(plot.line("best", _steps(done, best)))
    box = f"{LEFT} {TOP} {RIGHT - LEFT} {BOTTOM - TOP}"  # an svg in the svg hides what is under its lower edge
    place = 'x="{}" y="{}" width="{}" height="{}"'.format(*box.split())
    curve = f'<svg {place} viewBox="{box}">{"".join(lines)}</svg>'
    inside = "".join([*_bands(plot, history), *_ticks(plot), curve])
    return f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="score by evaluations">{inside}</svg>'


@dataclass(frozen=True)
class _Plot:
    """Where scores from `low` to `high`, and evaluations from 0 to `end`, are in the picture."""

    low: float
    high: float
    end: float

    def x(self, evaluations: float) -> float:
        return LEFT + (RIGHT - LEFT) * evaluations / self.end

    def y(self, score: float) -> float:
        return BOTTOM - (BOTTOM - TOP) * (score - self.low) / (self.high - self.low)

    def line(self, kind: str, places: Iterable[tuple[float, float]]) -> str:
        points = " ".join(f"{self.x(evaluations):.1f},{self.y(score):.1f}" for evaluations, score in places)
        return f'<polyline class="{kind}" points="{points}"/>'


def _steps(done: NDArray[np.float64], values: NDArray[np.float64]) -> Iterator[tuple[float, float]]:
    """Corners of a line that stays level until the value changes."""
    last = values[0]
    for evaluations, value in zip(done, values, strict=True):
        if value != last:
            yield evaluations, last
        if value != last or evaluations in (done[0], done[-1]):
            yield evaluations, value
        last = value


def _bands(plot: _Plot, history: Sequence[Generation]) -> Iterator[str]:
    stages = stages_of(history)
    for stage in stages[::2]:
        left, right = plot.x(stage.first), plot.x(stage.last)
        yield f'<rect class="band" x="{left:.1f}" y="{TOP}" width="{right - left:.1f}" height="{BOTTOM - TOP}"/>'
    for label in labels_of(stages):
        left, right = plot.x(label.first), plot.x(label.last)
        words = next((words for words in label.words if font(LETTERS).getlength(words) <= right - left + 8), "")
        middle = (left + right) / 2
        yield f'<text x="{middle:.1f}" y="{TOP - 8}" text-anchor="middle">{escape(words)}</text>' if words else ""


def _ticks(plot: _Plot) -> Iterator[str]:
    for score in _round_numbers(plot.low, plot.high, 6):
        y = plot.y(score)
        yield f'<line class="grid" x1="{LEFT}" x2="{RIGHT}" y1="{y:.1f}" y2="{y:.1f}"/>'
        yield f'<text x="{LEFT - 7}" y="{y + 4:.1f}" text-anchor="end">{score:.2f}</text>'
    for evaluations in _round_numbers(0, plot.end, 6):
        anchor = "end" if evaluations == plot.end else "middle"
        yield f'<text x="{plot.x(evaluations):.1f}" y="{BOTTOM + 20}" text-anchor="{anchor}">{evaluations:,.0f}</text>'


def _round_numbers(low: float, high: float, most: int) -> list[float]:
    """At most `most` multiples, or one more, of 1, 2 or 5 times a power of ten from `low` to `high`."""
    steps = (size * float(ten) for ten in 10.0 ** np.arange(-6, 12) for size in (1, 2, 5))
    step = next(step for step in steps if step * most >= high - low)
    return [step * i for i in range(int(np.ceil(low / step - 1e-9)), int(np.floor(high / step + 1e-9)) + 1)]
