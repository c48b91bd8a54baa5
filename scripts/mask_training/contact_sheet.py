"""Contact sheet: painted scenes with their classes, to look at.

Usage: python -m scripts.mask_training.contact_sheet [--count 48] [--seed 0] [--size 192] [--path scenes.png]
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from PIL import Image

from scripts.mask_training.scene import scene
from treefit.image.overlay import overlay
from treefit.image.picture import Picture

COLUMNS = 12


def main() -> None:
    """Write the sheet."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=48)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--size", type=int, default=192)
    parser.add_argument("--path", type=Path, default=Path("scenes.png"))
    arguments = parser.parse_args()
    numbers = range(arguments.first, arguments.first + arguments.count)
    sheet(arguments.seed, numbers, arguments.size).save(arguments.path, optimize=True)


def sheet(seed: int, numbers: range, size: int) -> Image.Image:
    """Rows of pictures, each beside its overlay."""
    tiles = [tile for number in numbers for tile in _pair(seed, number, size)]
    tiles += [np.zeros_like(tiles[0])] * (-len(tiles) % COLUMNS)
    rows = [np.hstack(tiles[at : at + COLUMNS]) for at in range(0, len(tiles), COLUMNS)]
    return Image.fromarray(np.vstack(rows))


def _pair(seed: int, number: int, size: int) -> tuple[np.ndarray, np.ndarray]:
    rgb, classes = scene(seed, number, size)
    return rgb, np.asarray(overlay(Picture(rgb), classes))


if __name__ == "__main__":
    main()
