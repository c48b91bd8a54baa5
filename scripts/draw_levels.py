"""Draws experiments/figures/levels.png: one tree in all its levels of detail, with their triangles and silhouettes.

python -m scripts.draw_levels [preset of weberpenn]
"""

from __future__ import annotations

import sys
from pathlib import Path

from PIL import Image, ImageDraw

from generators.weberpenn import WeberPennGen
from treefit.asset import AssetSettings
from treefit.asset.lod.levels import Level, levels_of
from treefit.asset.pictures.font import bold, font
from treefit.asset.pictures.picture import draw, frame_of
from treefit.plant import Budget

FILE = Path(__file__).parents[1] / "experiments" / "figures" / "levels.png"
PRESET = "quaking_aspen"
HEIGHT, TEXT, GAP = 420, 52, 10


def main() -> None:
    generator = WeberPennGen()
    preset = generator.presets[sys.argv[1] if len(sys.argv) > 1 else PRESET]
    plant = generator(generator.space.complete(preset.values), preset.seed, Budget(200_000, 400_000))
    levels = levels_of(plant, AssetSettings())
    frame = frame_of(levels[0].model, HEIGHT)
    sheet = Image.new("RGB", (len(levels) * (frame.width + GAP) - GAP, HEIGHT + TEXT), "white")
    for i, level in enumerate(levels):
        left = i * (frame.width + GAP)
        sheet.paste(Image.fromarray(draw(level.model, frame)), (left, 0))
        _write(ImageDraw.Draw(sheet), level, left)
    sheet.save(FILE, optimize=True)


def _write(draw_on: ImageDraw.ImageDraw, level: Level, left: int) -> None:
    alike = "" if level.model.name.endswith("LOD0") else f", silhouette IoU {level.silhouette_iou:.2f}"
    draw_on.text((left + 2, HEIGHT + 8), level.model.name, fill="#222", font=bold(14))
    draw_on.text((left + 2, HEIGHT + 28), f"{level.triangles:,} triangles{alike}", fill="#666", font=font(13))


if __name__ == "__main__":
    main()
