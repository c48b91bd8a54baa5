"""The viewer page of a fit: its candidates in 3D, with their facts, parameters and files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from experiments.candidate_facts import BY_NAME
from experiments.candidate_words import tables
from experiments.read_tree import ReadTree
from experiments.run_folder import candidate_folder
from treefit.asset import Level, MeshCounts, ParameterRow, ShownTree, write_viewer
from treefit.candidates import Candidate
from treefit.plant import Parameter, ParameterSpace, Value


def write_page(
    folder: Path,
    tree: ReadTree,
    found: list[Candidate],
    meshes: list[MeshCounts],
    space: ParameterSpace,
    levels: list[list[Level]] | None = None,
) -> None:
    """Write viewer.html: the candidates in 3D beside and over the picture; their files are in `folder` already."""
    levels = levels or [[] for _ in found]
    trees = [_shown(folder, i + 1, *each) for i, each in enumerate(zip(found, meshes, levels, strict=True))]
    title = f"{tree.name}: {len(found)} {'tree' if len(found) == 1 else 'trees'}"
    write_viewer(
        folder / "viewer.html", trees, tree.picture.rgb, tree.extraction.mask, parameter_rows(found, space), title
    )


def _shown(folder: Path, number: int, found: Candidate, mesh: MeshCounts, levels: list[Level]) -> ShownTree:
    files = candidate_folder(folder, number)
    lods = files / "tree_lods.glb"
    score = BY_NAME["score"]
    return ShownTree(
        f"candidate {number}",
        lods if lods.exists() else files / "tree.glb",
        tables(found, mesh),
        note=score.phrase(found.score.total),
        height=found.extent.height,
        mask=found.mask,
        picture=np.asarray(Image.open(files / "picture.png").convert("RGB")),
        preset=(files / "preset.yaml").read_text(encoding="utf-8"),
        folder=files.relative_to(folder).as_posix(),
        levels=levels,
    )


def parameter_rows(found: list[Candidate], space: ParameterSpace) -> list[ParameterRow]:
    """Every parameter with its value in each candidate; those that were not searched have no place in a range."""
    free = set(space.names)
    return [_row(parameter, [each.values[parameter.name] for each in found], parameter.name in free)
            for parameter in space.parameters]  # fmt: skip


def _row(parameter: Parameter, values: list[Value], free: bool) -> ParameterRow:
    unit = "" if parameter.unit == "1" else parameter.unit
    ranged = parameter.kind in ("float", "int")
    limits = f"{parameter.low:g} to {parameter.high:g} {unit}".strip() if ranged else ", ".join(parameter.choices)
    searched = (f"searched: {limits}" if limits else "searched") if free else "not searched"
    return ParameterRow(
        parameter.name,
        values,
        [parameter.encode(value) if free and ranged else None for value in values],
        unit,
        "\n".join(line for line in (parameter.doc, searched) if line),
    )
