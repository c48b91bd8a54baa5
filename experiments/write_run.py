"""What a fit leaves behind: files of every candidate, gallery, viewer page, table and summary."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
from PIL import Image

from experiments.candidate_facts import record
from experiments.candidate_words import caption, tables
from experiments.read_tree import ReadTree
from experiments.run_folder import candidate_folder
from treefit.asset import (
    AssetSettings,
    GalleryEntry,
    MeshCounts,
    gallery,
    picture,
    write_glb,
    write_viewer,
)
from treefit.candidates import Candidate
from treefit.image import write_mask
from treefit.plant import Generator, write_preset


def write_candidates(
    folder: Path, found: list[Candidate], generator: Generator, asset: AssetSettings
) -> list[MeshCounts]:
    """Write tree.glb, preset.yaml, picture.png and mask.png of every candidate; return the counts of their meshes."""
    return [
        _write_candidate(candidate_folder(folder, i + 1), candidate, generator, asset)
        for i, candidate in enumerate(found)
    ]


def _write_candidate(folder: Path, found: Candidate, generator: Generator, asset: AssetSettings) -> MeshCounts:
    folder.mkdir(parents=True, exist_ok=True)
    write_preset(folder / "preset.yaml", generator=generator.name, version=generator.version, seed=found.seed,
                 values=found.values, notes={"score": found.score.total})  # fmt: skip
    write_mask(found.mask, folder / "mask.png")
    Image.fromarray(picture(found.plant, asset)).save(folder / "picture.png")
    return write_glb(found.plant, folder / "tree.glb", asset)


def write_gallery(folder: Path, tree: ReadTree, found: list[Candidate], meshes: list[MeshCounts], title: str) -> None:
    """Write gallery.png: picture and mask beside those of the candidates, as in the paper's figures 4 to 9."""
    entries = [
        GalleryEntry(
            f"candidate {i + 1}",
            np.asarray(Image.open(candidate_folder(folder, i + 1) / "picture.png")),
            candidate.mask,
            caption(candidate, mesh),
        )
        for i, (candidate, mesh) in enumerate(zip(found, meshes, strict=True))
    ]
    Image.fromarray(gallery(tree.picture.rgb, tree.extraction.mask, entries, title)).save(folder / "gallery.png")


def write_page(folder: Path, tree: ReadTree, found: list[Candidate], meshes: list[MeshCounts]) -> None:
    """Write viewer.html: the candidates in 3D beside the picture."""
    trees = [
        (f"candidate {i + 1}", candidate_folder(folder, i + 1) / "tree.glb", tables(candidate, mesh))
        for i, (candidate, mesh) in enumerate(zip(found, meshes, strict=True))
    ]
    write_viewer(folder / "viewer.html", trees, tree.picture.rgb, tree.extraction.mask)


def write_table(path: Path, found: list[Candidate], meshes: list[MeshCounts]) -> None:
    """Write candidates.csv: a row a candidate, a column a fact; empty where it is not known."""
    records = [record(candidate, mesh) for candidate, mesh in zip(found, meshes, strict=True)]
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, ["candidate", *records[0]], lineterminator="\n")
        table.writeheader()
        table.writerows({"candidate": i + 1, **known} for i, known in enumerate(records))


def write_json(path: Path, facts: dict[str, object]) -> None:
    """Write `facts` to `path` at once or not at all."""
    unfinished = path.with_name(path.name + ".tmp")
    unfinished.write_text(json.dumps(facts, indent=1, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8")
    unfinished.replace(path)
