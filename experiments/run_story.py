"""The story of a fit for the page of its run: best score and pictures at first sight, all candidates as a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path

import numpy as np
from PIL import Image

from experiments.candidate_facts import BY_NAME, OTHER_SEEDS, record
from experiments.errors import one_line
from experiments.glance import write_glance
from experiments.read_tree import ReadTree
from experiments.run_folder import candidate_folder
from treefit.asset import MeshCounts
from treefit.candidates import Candidate
from treefit.mask import PALETTE
from treefit.tracking import Story, Table
from treefit.tracking.story import Cell

GLANCE = "glance.png"
TABLE = "candidates_table"
LINKS = {
    "turn it in 3D": "viewer.html",
    "gallery": "gallery.png",
    "candidates": f"{TABLE}.json",
    "score curve": "score_curve.png",
    "how it was found": "best_strip.png",
    "settings": "config.yaml",
}
"""What the description leads to, where there is such a file."""

SHOWN = ("silhouette_iou", "class_iou")
"""Facts of the best candidate that are told beside its score."""

MOST_PICTURES = 6
"""Candidates that are shown beside each other; the table has all."""


def fit_story(
    folder: Path, tree: ReadTree, found: Sequence[Candidate], meshes: Sequence[MeshCounts], how: str
) -> Story:
    """Story of the run in `folder`, whose files are written; `how` says by what it was found, in a few words."""
    pictures = [candidate_folder(folder, i + 1) / "picture.png" for i in range(len(found))]
    _write_glance(folder / GLANCE, tree, found, pictures)
    records = [record(candidate, mesh) for candidate, mesh in zip(found, meshes, strict=True)]
    there = {text: file for text, file in LINKS.items() if file.startswith(TABLE) or (folder / file).is_file()}
    return Story(
        description=beside(GLANCE, [*_lines(records[0], tree, how, len(found)), links(there)]),
        pictures={"candidates/0 picture and mask": folder / "mask_overlay.png"}
        | {f"candidates/{i + 1}": picture for i, picture in enumerate(pictures[:MOST_PICTURES])}
        | {"candidates/gallery": folder / "gallery.png"},
        tables={TABLE: _table(records, pictures)},
    )


def failure_story(tree: ReadTree, how: str, error: Exception) -> Story:
    """Story of a run that failed."""
    return Story(f"<b>failed</b>: {escape(one_line(error))}<br>{escape(tree.name)} by {escape(how)}")


def beside(picture: str, lines: Sequence[str]) -> str:
    """HTML of `lines` beside the file `picture`: what is not higher than it is seen without unfolding."""
    return f'<table><tr><td><img src="{escape(picture)}"></td><td>{"<br>".join(lines)}</td></tr></table>'


def links(there: Mapping[str, str]) -> str:
    """HTML of links to files, by their words."""
    return " · ".join(f'<a href="{escape(file)}">{escape(text)}</a>' for text, file in there.items())


def _lines(best: dict[str, float | int | None], tree: ReadTree, how: str, count: int) -> list[str]:
    score = BY_NAME["score"]
    other = best[f"score_{OTHER_SEEDS}"]
    candidates = f"{count} candidates" if count > 1 else "one candidate"
    return [
        f"<b>{score.phrase(best['score'])}</b>"
        + (f", {score.value(other)} on other seeds" if other is not None else ""),
        ", ".join(BY_NAME[name].phrase(best[name]) for name in SHOWN),
        f"{candidates} for {escape(tree.name)} by {escape(how)}",
    ]


def _write_glance(path: Path, tree: ReadTree, found: Sequence[Candidate], pictures: Sequence[Path]) -> None:
    cells = [
        ("picture", Image.fromarray(tree.picture.rgb)),
        ("mask", Image.fromarray(np.array(PALETTE, np.uint8)[tree.extraction.mask])),
    ]
    for candidate, picture in zip(found, pictures, strict=True):
        with Image.open(picture) as image:
            cells.append((BY_NAME["score"].value(candidate.score.total), image.convert("RGB")))
    write_glance(path, cells)


def _table(records: Sequence[dict[str, float | int | None]], pictures: Sequence[Path]) -> Table:
    rows: list[dict[str, Cell]] = []
    for number, (known, picture) in enumerate(zip(records, pictures, strict=True), start=1):
        facts: dict[str, Cell] = {_head(name): _cell(name, value) for name, value in known.items()}
        rows.append({"candidate": number, "picture": picture, **facts})
    return rows


def _head(name: str) -> str:
    here = name.removesuffix(f"_{OTHER_SEEDS}")
    return BY_NAME[here].words + (", other seeds" if here != name else "")


def _cell(name: str, value: float | int | None) -> str:
    return BY_NAME[name.removesuffix(f"_{OTHER_SEEDS}")].value(value)
