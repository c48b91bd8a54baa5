"""Viewer: one HTML page with the trees in 3D beside and over the picture; works from disk, without a network."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from treefit.asset.page.embed import integrity, json_for_script, mask_address, packed, picture_address
from treefit.asset.page.facts import FactTable, ParameterRow, plain_parameter, plain_table
from treefit.asset.page.three import three_js
from treefit.mask import Mask
from treefit.placing import place

_FOLDER = "viewer"  # beside this file: the page, its style and its script, which is joined from these in order
_SCRIPTS = ("state.js", "trees.js", "wind.js", "camera.js", "scene.js", "overlay.js", "cells.js", "tables.js",
            "parameters.js", "files.js", "controls.js", "pointer.js", "start.js")  # fmt: skip
_PICTURE, _MASK, _THUMBNAIL = 1200, 1024, 360  # longest sides of what is embedded, in pixels


@dataclass(frozen=True)
class Level:
    """A level of detail: its triangles, and the overlap (IoU) of its silhouette with that of the first, if known."""

    triangles: int
    iou: float | None = None


@dataclass(frozen=True, eq=False)
class ShownTree:
    """One tree of the page; what is left out is not shown.

    `glb` is embedded and may be saved from the page; nodes tree_LOD0, tree_LOD1 ... in it are levels of detail.
    """

    name: str
    glb: Path
    tables: Sequence[FactTable] = ()
    note: str = ""  # a few words under the name
    height: float | None = None  # m, of the plant that `mask` shows; else that of the model
    mask: Mask | None = None  # (rows, columns): the plant's height is all rows, its base the middle column
    picture: NDArray[np.uint8] | None = None  # (h, w, 3)
    preset: str = ""  # text of the preset's file
    folder: str = ""  # where its files lie, relative to the page
    levels: Sequence[Level] = ()


def write_viewer(
    path: Path | str,
    trees: Sequence[ShownTree],
    picture_rgb: NDArray[np.uint8],
    mask: Mask,
    parameters: Sequence[ParameterRow] = (),
    title: str = "Trees fitted to a picture",
) -> None:
    """Write the page to `path`: `trees` beside and over the picture (h, w, 3) with its mask (h, w), and their facts."""
    if not trees:
        raise ValueError("viewer: needs one tree or more, got none")
    facts = {
        "title": title,
        "picture": _placed(picture_rgb, mask),
        "trees": [_plain(tree) for tree in trees],
        "parameters": [plain_parameter(row) for row in parameters],
    }
    glbs = (f'<script class="glb" type="text/plain">{packed(Path(tree.glb).read_bytes())}</script>' for tree in trees)
    style, script = _read("viewer.css"), _script()
    parts = {
        "three": three_js(),
        "script": script,
        "style": style,
        "script_hashes": f"{integrity(three_js())} {integrity(script)}",
        "style_hash": integrity(style),
        "facts": json_for_script(facts),
        "glbs": "\n".join(glbs),
    }
    page = re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found.group(1)], _read("viewer.html"))
    Path(path).write_text(page, encoding="utf-8", newline="\n")


def _placed(picture_rgb: NDArray[np.uint8], mask: Mask) -> dict[str, object]:
    """Return the picture with its mask, and where in it the tree stands, in shares of its width and height."""
    height, width = mask.shape
    at = place(mask) if mask.any() else None
    return {
        "picture": picture_address(picture_rgb, _PICTURE),
        "mask": mask_address(mask, _MASK),
        "ratio": picture_rgb.shape[1] / picture_rgb.shape[0],
        "base": at.base / width if at else 0.5,
        "top": at.top / height if at else 0.0,
        "bottom": at.bottom / height if at else 1.0,
        "reach": at.reach if at else 0.5 * width / height,
    }


def _plain(tree: ShownTree) -> dict[str, object]:
    reach = 0.0
    if tree.mask is not None and tree.mask.any():
        columns = np.flatnonzero(tree.mask.any(axis=0))
        middle = tree.mask.shape[1] / 2
        reach = max(middle - float(columns[0]), float(columns[-1]) + 1 - middle) / tree.mask.shape[0]
    return {
        "name": tree.name,
        "note": tree.note,
        "tables": [plain_table(table) for table in tree.tables],
        "height": tree.height,
        "reach": reach,
        "mask": None if tree.mask is None else mask_address(tree.mask, _MASK),
        "picture": None if tree.picture is None else picture_address(tree.picture, _THUMBNAIL),
        "preset": tree.preset,
        "folder": tree.folder,
        "glb": Path(tree.glb).name,
        "levels": [{"triangles": level.triangles, "iou": _known(level.iou)} for level in tree.levels],
    }


def _known(share: float | None) -> float | None:
    return share if share is not None and math.isfinite(share) else None


@cache
def _script() -> str:
    parts = "\n".join(_read(name) for name in _SCRIPTS)
    return f'"use strict";\n(function () {{\n{parts}\n}}());\n'


@cache
def _read(name: str) -> str:
    return resources.files("treefit.asset.page").joinpath(_FOLDER, name).read_text(encoding="utf-8")
