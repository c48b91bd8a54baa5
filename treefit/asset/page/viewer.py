"""Viewer: one HTML page with the candidates in 3D beside the picture; works from disk, without a network."""

from __future__ import annotations

import base64
import io
import json
import math
import re
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from treefit.mask import PALETTE, Mask

_PAGE = "viewer.html"  # beside this file; the words between double braces are filled in
_SHOWN = 640  # longest side of the embedded picture in pixels
_THREE_BEGINS, _THREE_ENDS = "/**\n * @license", "THREE.GLTFLoader=GLTFLoader;})();"  # trimesh's own start code follows


@dataclass(frozen=True)
class FactRow:
    """One fact: its name, a value for each column of its table, and what it means, told when one points at it."""

    name: str
    values: Sequence[str | float]
    meaning: str = ""


@dataclass(frozen=True)
class FactTable:
    """Facts under one title; `columns` are heads of the values, `folded` shows the title only until it is clicked."""

    title: str
    rows: Sequence[FactRow]
    columns: Sequence[str] = ()
    folded: bool = False


def write_viewer(
    path: Path | str,
    glbs: Sequence[tuple[str, Path, Sequence[FactTable]]],
    picture_rgb: NDArray[np.uint8],
    mask: Mask,
) -> None:
    """Write the page to `path`: a tab for each (name, GLB file, tables) of `glbs`, the picture and mask at the side."""
    if not glbs:
        raise ValueError("viewer: needs one GLB file or more, got none")
    trees = [
        {
            "name": name,
            "tables": [_plain(table) for table in tables],
            "glb": base64.b64encode(Path(file).read_bytes()).decode("ascii"),
        }
        for name, file, tables in glbs
    ]
    colours = np.array(PALETTE, dtype=np.uint8)[mask]
    parts = {
        "three": _three(),
        "trees": _for_script(trees),
        "picture": _embedded(Image.fromarray(picture_rgb), "JPEG"),
        "mask": _embedded(Image.fromarray(colours), "PNG"),
    }
    template = resources.files("treefit.asset.page").joinpath(_PAGE).read_text(encoding="utf-8")
    page = re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found.group(1)], template)
    Path(path).write_text(page, encoding="utf-8")


def _plain(table: FactTable) -> dict[str, object]:
    rows = [{"name": row.name, "meaning": row.meaning, "values": [*map(_shown, row.values)]} for row in table.rows]
    return {"title": table.title, "columns": [*table.columns], "folded": table.folded, "rows": rows}


def _for_script(content: object) -> str:
    """JSON that can stand inside <script>: no character in it can end the element or begin a comment."""
    text = json.dumps(content, allow_nan=False)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _shown(value: str | float) -> str:
    """Return a fact as people read it: whole numbers in groups of three, others with three digits."""
    if isinstance(value, str | bool):
        return str(value)
    if not math.isfinite(value):
        return "-"
    if float(value).is_integer():
        return f"{int(value):,}"
    return f"{value:.3f}" if abs(value) < 10 else f"{value:,.1f}"


def _embedded(image: Image.Image, kind: str) -> str:
    """Return `image` as a data address, at most _SHOWN pixels long."""
    image.thumbnail((_SHOWN, _SHOWN), Image.Resampling.LANCZOS if kind == "JPEG" else Image.Resampling.BOX)
    content = io.BytesIO()
    image.convert("RGB").save(content, kind, quality=88)
    return f"data:image/{kind.lower()};base64,{base64.b64encode(content.getvalue()).decode('ascii')}"


@cache
def _three() -> str:
    """Return three.js with its GLTF loader, as trimesh ships it (MIT licence, kept in its first lines)."""
    packed = resources.files("trimesh").joinpath("resources", "templates", "viewer.zip").read_bytes()
    with zipfile.ZipFile(io.BytesIO(packed)) as archive:
        page = archive.read("viewer.html.template").decode("utf-8")
    begin, end = page.find(_THREE_BEGINS), page.find(_THREE_ENDS)
    if begin < 0 or end < 0:
        raise RuntimeError("trimesh's viewer template holds no three.js with a GLTF loader")
    return page[begin : end + len(_THREE_ENDS)]
