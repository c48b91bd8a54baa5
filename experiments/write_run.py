"""What a fit leaves behind: files of every candidate, gallery, viewer page and summary."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from PIL import Image

from experiments.read_tree import ReadTree
from experiments.run_folder import candidate_folder
from treefit.asset import (
    AssetSettings,
    GalleryEntry,
    MeshCounts,
    gallery,
    picture,
    write_glb,
    write_preset,
    write_viewer,
)
from treefit.candidates import Candidate
from treefit.image import write_mask
from treefit.plant import Generator


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


def write_gallery(folder: Path, tree: ReadTree, found: list[Candidate], title: str) -> None:
    """Write gallery.png: picture and mask beside those of the candidates, as in the paper's figures 4 to 9."""
    entries = [
        GalleryEntry(
            f"candidate {i + 1}",
            np.asarray(Image.open(candidate_folder(folder, i + 1) / "picture.png")),
            candidate.mask,
            _captions(candidate),
        )
        for i, candidate in enumerate(found)
    ]
    Image.fromarray(gallery(tree.picture.rgb, tree.extraction.mask, entries, title)).save(folder / "gallery.png")


def _captions(found: Candidate) -> tuple[str, ...]:
    other = "" if found.score_other_seeds is None else f" (other seeds {found.score_other_seeds:.3f})"
    return (
        f"score {found.score.total:.3f}{other}",
        f"silhouette IoU {found.silhouette_iou:.2f}, class IoU {found.class_iou:.2f}",
        f"{found.plant.n_vertices:,} vertices, {found.plant.n_leaves:,} leaves",
    )


def write_page(folder: Path, tree: ReadTree, found: list[Candidate], meshes: list[MeshCounts]) -> None:
    """Write viewer.html: the candidates in 3D beside the picture."""
    trees = [
        (f"candidate {i + 1}", candidate_folder(folder, i + 1) / "tree.glb", _facts(candidate, mesh))
        for i, (candidate, mesh) in enumerate(zip(found, meshes, strict=True))
    ]
    write_viewer(folder / "viewer.html", trees, tree.picture.rgb, tree.extraction.mask)


def _facts(found: Candidate, mesh: MeshCounts) -> dict[str, str | float]:
    other = {} if found.score_other_seeds is None else {"score on other seeds": found.score_other_seeds}
    return {
        "score": found.score.total, **other, "image similarity": found.score.image,
        "silhouette IoU": found.silhouette_iou, "class IoU": found.class_iou, "vertices": found.plant.n_vertices,
        "leaves": found.plant.n_leaves, "triangles": mesh.triangles, "height in m": found.extent.height,
        "width in m": found.extent.width,
    }  # fmt: skip


def write_json(path: Path, facts: dict[str, object]) -> None:
    """Write `facts` to `path` at once or not at all."""
    unfinished = path.with_name(path.name + ".tmp")
    unfinished.write_text(json.dumps(facts, indent=1, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8")
    unfinished.replace(path)
