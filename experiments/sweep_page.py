"""sweep.html: the table of a sweep as one page; names are shown as text, whatever is in them."""

from __future__ import annotations

import base64
import os
from html import escape
from io import BytesIO
from pathlib import Path
from urllib.parse import quote

from experiments.candidate_facts import BY_NAME
from experiments.sweep_picture import thumbnail
from experiments.sweep_table import Job, SweepTable

MEASURES = ("silhouette_iou", "hull_iou", "class_iou", "texture")
"""Facts of the best candidate that a cell shows under its scores."""

LEGEND = "Each cell: best candidate, its score, its mean score on other seeds, and how it agrees with the mask."

HEAD = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>treefit sweep</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy"
 content="default-src 'none'; img-src data:; style-src 'unsafe-inline'">
<style>
 :root { color-scheme: light dark; font: 15px/1.45 system-ui, sans-serif; }
 body { margin: 2rem; } h1 { font-size: 1.3rem; font-weight: 600; }
 .wide { overflow-x: auto; } table { border-collapse: separate; border-spacing: .6rem; }
 th { font-weight: 600; text-align: center; padding: .2rem .4rem; overflow-wrap: anywhere; max-width: 20rem; }
 td, tbody th { background: color-mix(in srgb, CanvasText 5%, Canvas); border-radius: .5rem; padding: .6rem; }
 td, tbody th { vertical-align: top; }
 img { display: block; width: 220px; height: 220px; object-fit: contain; background: #fff; }
 .score { font-variant-numeric: tabular-nums; display: flex; justify-content: space-between; }
 .score b { font-size: 1.15rem; } .best { outline: 2px solid #4c993c; }
 .failed { color: #c0392b; max-width: 220px; overflow-wrap: anywhere; } small { opacity: .75; }
</style></head><body>
"""


def write_page(table: SweepTable, file: Path) -> None:
    """Write `table` to `file`; links go to the runs' folders beside it."""
    heads = "".join(f"<th>{escape(column)}</th>" for column in table.columns)
    body = "".join(_row(table, row, file.parent) for row in table.rows)
    title = f"<h1>{escape(file.parent.name)}</h1>"
    legend = f"<p><small>{LEGEND}</small></p>"
    page = f"{HEAD}{title}{legend}<div class=wide><table><thead><tr><th></th>{heads}</tr></thead><tbody>{body}"
    file.write_text(f"{page}</tbody></table></div></body></html>\n", encoding="utf-8")


def _row(table: SweepTable, row: str, folder: Path) -> str:
    jobs = [table.cells.get((row, column)) for column in table.columns]
    best = max((job.score for job in jobs if job and job.score is not None), default=None)
    cells = "".join(_cell(job, best if len(jobs) > 1 else None, folder) for job in jobs)
    return f"<tr><th>{_image(Path(row))}{escape(Path(row).name)}</th>{cells}</tr>"


def _cell(job: Job | None, best: float | None, folder: Path) -> str:
    if job is None:
        return "<td></td>"
    if job.status != "done":
        return f"<td><div class=failed><b>{escape(job.status)}</b><br>{escape(job.error)}</div></td>"
    shown = f"<td{' class=best' if best is not None and job.score == best else ''}>{_image(job.picture)}"
    if job.score is not None:
        other = f"<small>{job.score_other_seeds:.3f}</small>" if job.score_other_seeds is not None else ""
        shown += f"<div class=score><b>{job.score:.3f}</b>{other}</div>{_measures(job)}"
    return f"{shown}{_link(job.folder / 'viewer.html', folder)}</td>"


def _measures(job: Job) -> str:
    known = ((BY_NAME[name], job.facts[name]) for name in MEASURES if name in job.facts)
    lines = (f"<small>{fact.words}</small><small>{fact.value(number)}</small>" for fact, number in known)
    return "".join(f"<div class=score>{line}</div>" for line in lines)


def _link(page: Path, folder: Path) -> str:
    if not page.is_file():
        return ""
    return f'<a href="{quote(os.path.relpath(page, folder))}" target="_blank">turn it in 3D</a>'


def _image(path: Path | None) -> str:
    image = thumbnail(path) if path else None
    if image is None:
        return ""
    data = BytesIO()
    image.save(data, format="PNG", optimize=True)
    return f'<img alt="" src="data:image/png;base64,{base64.b64encode(data.getvalue()).decode()}">'
