"""The story of a search in pictures: score_curve.png and best_strip.png in the folder of a run."""

from __future__ import annotations

from pathlib import Path

from experiments.best_strip import write_best_strip
from experiments.read_tree import ReadTree
from experiments.score_curve import draw_score_curve
from treefit.asset import AssetSettings
from treefit.fit import Result

CURVE, STRIP = "score_curve.png", "best_strip.png"


def write_search_story(folder: Path, result: Result, tree: ReadTree, asset: AssetSettings, title: str) -> None:
    """Write how the score rose, and how the best plant changed."""
    draw_score_curve(result.history, title, folder / CURVE)
    write_best_strip(folder / STRIP, result, tree.picture.rgb, asset, title, tree.colours)
