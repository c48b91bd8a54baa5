"""What a fit leaves behind: files of every candidate, gallery, viewer page, table and summary."""

from __future__ import annotations

import csv
import json
import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from PIL import Image

from experiments.candidate_facts import level_columns, record
from experiments.candidate_words import caption
from experiments.dressing import look_of
from experiments.read_tree import ReadTree
from experiments.run_folder import candidate_folder
from experiments.stripes_figure import stripes_figure
from treefit.asset import (
    AssetSettings,
    GalleryEntry,
    MeshCounts,
    TreeColours,
    TreeFiles,
    gallery,
    picture,
    write_tree,
)
from treefit.candidates import Candidate
from treefit.image import write_mask
from treefit.plant import Generator, write_preset


def write_candidates(
    folder: Path, found: list[Candidate], generator: Generator, asset: AssetSettings, seen: TreeColours
) -> list[TreeFiles]:
    """Write preset.yaml, mask.png, picture.png and the 3D files of every candidate, in the colours that are `seen`.

    Several at once, one a core: what takes time in it runs without Python's lock. OpenGL knows one thread only.
    """
    at_once = 1 if asset.renderer == "pyrender" else min(len(found), os.cpu_count() or 1)
    with ThreadPoolExecutor(at_once) as pool:
        jobs = [
            pool.submit(_write_candidate, candidate_folder(folder, i + 1), candidate, generator, asset, seen)
            for i, candidate in enumerate(found)
        ]
        return [job.result() for job in jobs]


def _write_candidate(
    folder: Path, found: Candidate, generator: Generator, asset: AssetSettings, seen: TreeColours
) -> TreeFiles:
    folder.mkdir(parents=True, exist_ok=True)
    write_preset(folder / "preset.yaml", generator=generator.name, version=generator.version, seed=found.seed,
                 values=found.values, look=look_of(asset, seen), notes={"score": found.score.total})  # fmt: skip
    write_mask(found.mask, folder / "mask.png")
    Image.fromarray(picture(found.plant, asset, seen=seen)).save(folder / "picture.png")
    return write_tree(folder, found.plant, asset, seen)


def write_sheets(folder: Path, tree: ReadTree, found: list[Candidate], meshes: list[MeshCounts], title: str) -> None:
    """Write gallery.png, picture and mask beside those of the candidates, and stripes.png, how these are compared.

    They are figures 4 to 9, and 1 and 2, of the paper.
    """
    entries = [
        GalleryEntry(
            f"candidate {i + 1}",
            np.asarray(Image.open(candidate_folder(folder, i + 1) / "picture.png")),
            candidate.mask,
            caption(candidate, mesh),
        )
        for i, (candidate, mesh) in enumerate(zip(found, meshes, strict=True))
    ]
    given = tree.picture.rgb, tree.extraction.mask
    Image.fromarray(gallery(*given, entries, title)).save(folder / "gallery.png")
    Image.fromarray(stripes_figure(*given, entries, title=title)).save(folder / "stripes.png")


def write_table(path: Path, found: list[Candidate], files: list[TreeFiles]) -> None:
    """Write candidates.csv: a row a candidate, a column a fact; empty where it is not known."""
    records = [{**record(each, tree.counts), **level_columns(tree)} for each, tree in zip(found, files, strict=True)]
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, ["candidate", *records[0]], lineterminator="\n")
        table.writeheader()
        table.writerows({"candidate": i + 1, **known} for i, known in enumerate(records))


def write_json(path: Path, facts: dict[str, object]) -> None:
    """Write `facts` to `path` at once or not at all."""
    unfinished = path.with_name(path.name + ".tmp")
    unfinished.write_text(json.dumps(facts, indent=1, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8")
    unfinished.replace(path)
