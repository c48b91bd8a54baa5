"""glance.png: a row of small captioned pictures, as low as what mlflow's page of a run shows without unfolding."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PIL import Image, ImageDraw, ImageOps

from treefit.asset.pictures.font import fitted, font

HEIGHT, CAPTION, GAP, WIDEST = 76, 17, 8, 400
"""Pixels: of a picture, of the line under it, between pictures, of the whole row at most."""

INK, PAPER = (60, 60, 60), (255, 255, 255)
LETTERS = 12


def write_glance(path: Path, cells: Sequence[tuple[str, Image.Image]]) -> None:
    """Write the row of `cells`, each a caption and its picture; those that find no room are left out."""
    shown: list[tuple[str, Image.Image, int]] = []
    right = 0
    for caption, picture in cells:
        small = ImageOps.contain(picture, (2 * HEIGHT, HEIGHT))
        width = max(small.width, HEIGHT // 2)
        if right + width > WIDEST:
            break
        shown.append((caption, small, right))
        right += width + GAP
    sheet = Image.new("RGB", (right + GAP, HEIGHT + CAPTION), PAPER)
    for caption, small, left in shown:
        sheet.paste(small, (left, HEIGHT - small.height))
        text = fitted(caption, LETTERS, max(small.width, HEIGHT // 2))
        ImageDraw.Draw(sheet).text((left, HEIGHT + 3), text, fill=INK, font=font(LETTERS))
    unfinished = path.with_name(f"{path.name}.tmp")
    sheet.save(unfinished, format="PNG")  # the tracking may be reading the row of a moment ago
    unfinished.replace(path)
