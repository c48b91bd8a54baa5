"""The story of a sweep for the page of its parent run: how far it is, the best tree of every picture, all scores."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from PIL import Image

from experiments.candidate_facts import BY_NAME
from experiments.glance import write_glance
from experiments.run_story import beside, links
from experiments.sweep_picture import thumbnail
from experiments.sweep_table import Job, SweepTable
from treefit.tracking import Story, Table
from treefit.tracking.story import Cell

GLANCE = "sweep_glance.png"
TABLE = "sweep_table"
LINKS = {"table": f"{TABLE}.json", "page": "sweep.html", "picture": "sweep.png"}
MOST_ROWS, MOST_COLUMNS = 2, 4
"""Scores that are told in the description; the table has all of them."""


def sweep_story(folder: Path, jobs: Sequence[Job], table: SweepTable) -> Story:
    """Story of the sweep in `folder`; its table's pictures are those of the runs that are done."""
    _write_glance(folder / GLANCE, table)
    words = f"{_count(jobs)} · {links(LINKS)}{_scores(table)}"
    return Story(beside(GLANCE, [words]), tables={TABLE: _table(table)})


def numbers(jobs: Sequence[Job]) -> dict[str, float]:
    """Numbers of a sweep: how many runs, and the best score; `score` is what runs are listed with."""
    scores = [job.score for job in jobs if job.score is not None]
    best = {"score": round(max(scores), 4), "best_score": round(max(scores), 4)} if scores else {}
    return {"runs": len(jobs), "failed": sum(job.status == "failed" for job in jobs), **best}


def _count(jobs: Sequence[Job]) -> str:
    by_status = {status: sum(job.status == status for job in jobs) for status in ("done", "failed", "running")}
    told = [f"{count} {status}" for status, count in by_status.items() if count]
    best = max((job for job in jobs if job.score is not None), key=lambda job: job.score or 0, default=None)
    score = f"<b>best {_linked(best)}</b>, " if best is not None else ""
    return f"{score}{', '.join(told)}" if jobs else "no runs yet"


def _scores(table: SweepTable) -> str:
    """HTML of the scores by picture and choice, each a link to its run; none where they would find no room."""
    if len(table.rows) > MOST_ROWS or len(table.columns) > MOST_COLUMNS:
        return ""
    heads = "".join(f"<td>{escape(column)}&nbsp;</td>" for column in table.columns)
    lines = [f"<tr><td></td>{heads}</tr>"]
    for row in table.rows:
        jobs = (table.cells.get((row, column)) for column in table.columns)
        told = "".join(f"<td>{'' if job is None else _linked(job)}</td>" for job in jobs)
        lines.append(f"<tr><td>{escape(Path(row).name)}&nbsp;</td>{told}</tr>")
    return f"<table>{''.join(lines)}</table>"


def _linked(job: Job) -> str:
    told = escape(job.status) if job.score is None else BY_NAME["score"].value(job.score)
    return f'<a href="run:{escape(job.run)}">{told}</a>' if job.run else told


def _write_glance(path: Path, table: SweepTable) -> None:
    """Write each picture beside the best tree that was found for it."""
    cells: list[tuple[str, Image.Image]] = []
    for row in table.rows:
        jobs = [job for column in table.columns if (job := table.cells.get((row, column))) and job.score is not None]
        best = max(jobs, key=lambda job: job.score or 0, default=None)
        shown = [(Path(row).name, Path(row))]
        if best is not None and best.picture is not None:
            shown.append((BY_NAME["score"].value(best.score), best.picture))
        cells += [(caption, image) for caption, file in shown if (image := thumbnail(file)) is not None]
    write_glance(path, cells)


def _table(table: SweepTable) -> Table:
    rows: list[dict[str, Cell]] = []
    for row in table.rows:
        line: dict[str, Cell] = {"picture": Path(row), "name": Path(row).name}
        for column in table.columns:
            job = table.cells.get((row, column))
            line[column] = job.picture if job is not None and job.picture is not None else ""
            line[f"{column}: score"] = "" if job is None else _words(job)
        rows.append(line)
    return rows


def _words(job: Job) -> str:
    if job.score is None:
        return f"{job.status} {job.error}".strip()
    return BY_NAME["score"].value(job.score)
