"""The page of the task speed_study: what was measured, as Markdown."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

OURS, GENERATE = "bit rows (ours)", "growing the tree itself"
LIBRARIES = {"numba": "numba", "numpy": "numpy", "OpenCV": "opencv-python-headless", "pyrender2": "pyrender2"}


@dataclass(frozen=True)
class Point:
    """Milliseconds by name for trees of so many vertices and leaves (means) in a mask of so many rows."""

    vertices: int
    leaves: int
    rows: int
    ms: dict[str, float]


def page(generator: str, by_size: Sequence[Point], by_rows: Sequence[Point], figure: Path, how: str) -> str:
    """The tables with the command that makes them, `how` they were measured and with what."""
    where = f"figures/{figure.name}" if figure.parent.name == "figures" else figure.name
    return "\n".join([
        "# Speed", "",
        f"![Time by size of the tree and of the mask]({where})", "",
        f"Milliseconds a tree of `{generator}` on one core, {how};",
        "in brackets how many times as long as ours. pyrender works on all cores and has its time on the clock.", "",
        "Made by `python run.py task=speed_study speed_study.renew=true`",
        f"with {_versions()}.", "",
        f"## By size of the tree, masks of {by_size[0].rows} rows", "", *_rows(by_size), "",
        f"## By rows of the mask, trees of about {round(by_rows[0].vertices, -3):,} vertices", "", *_rows(by_rows), "",
    ])  # fmt: skip


def _rows(points: Sequence[Point]) -> list[str]:
    head = ["vertices", "leaves", "rows", *points[0].ms]
    lines = [head, ["---:"] * len(head)]
    for point in points:
        times = [
            f"{ms:.3g}" + ("" if name in (OURS, GENERATE) else f" ({ms / point.ms[OURS]:.0f}x)")
            for name, ms in point.ms.items()
        ]
        lines.append([f"{point.vertices:,}", f"{point.leaves:,}", str(point.rows), *times])
    return ["| " + " | ".join(line) + " |" for line in lines]


def _versions() -> str:
    found = [f"Python {platform.python_version()}"]
    for title, package in LIBRARIES.items():
        try:
            found.append(f"{title} {version(package)}")
        except PackageNotFoundError:
            found.append(f"no {title}")
    return ", ".join(found)
