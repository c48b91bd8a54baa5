"""Tables with small pictures as mlflow's pages read them: JSON beside a folder of thumbnails."""

from __future__ import annotations

import json
from pathlib import Path

from PIL import Image, ImageOps

from treefit.tracking.story import Cell, Table

SIDE = 160
"""Pixels of the longer side of a thumbnail."""


def write_table(folder: Path, name: str, table: Table) -> list[Path]:
    """Write `table` to folder/name.json and its thumbnails below folder/table_images; return all files, JSON last.

    A picture that cannot be read is an empty cell.
    """
    columns = list(table[0]) if table else []
    written: list[Path] = []

    def cell(value: Cell, row: int, column: int) -> object:
        if not isinstance(value, Path):
            return value
        file = folder / "table_images" / name / f"{row}_{column}.webp"
        if not _thumbnail(value, file):
            return ""
        written.append(file)
        place = file.relative_to(folder).as_posix()
        return {"type": "image", "filepath": place, "compressed_filepath": place}

    data = [[cell(line[column], y, x) for x, column in enumerate(columns)] for y, line in enumerate(table, start=1)]
    page = folder / f"{name}.json"
    page.write_text(json.dumps({"columns": columns, "data": data}, allow_nan=False), encoding="utf-8")
    return [*written, page]


def _thumbnail(picture: Path, file: Path) -> bool:
    try:
        with Image.open(picture) as image:
            small = ImageOps.contain(on_white(image), (SIDE, SIDE))
    except (OSError, ValueError):
        return False
    file.parent.mkdir(parents=True, exist_ok=True)
    small.save(file, format="WEBP", quality=85)
    return True


def on_white(image: Image.Image) -> Image.Image:
    """Return `image` without transparency."""
    layer = image.convert("RGBA")
    return Image.alpha_composite(Image.new("RGBA", layer.size, "white"), layer).convert("RGB")
