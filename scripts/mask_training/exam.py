"""Exam: painted scenes that no training saw, as pictures with exact masks, for task=masks.

Usage: python -m scripts.mask_training.exam [--count 40] [--size 384] [--kinds clip-art sketch ...] [--folder exam]
Then:  python run.py task=masks 'masks.pictures=exam/*.png' 'masks.references=exam/mask_*.png' 'masks.methods=[auto]'
"""

from __future__ import annotations

import argparse
from itertools import count, islice
from pathlib import Path

from PIL import Image

from scripts.mask_training.scene import KINDS, kind_of, scene
from treefit.image.read import write_mask

SEED = 2_000_003
"""Neither the seed of a training nor that of its validation."""


def main() -> None:
    """Write <kind>_<number>.png and mask_<kind>_<number>.png."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--size", type=int, default=384, help="pixels of a side")
    parser.add_argument("--kinds", nargs="+", choices=list(KINDS), default=list(KINDS))
    parser.add_argument("--folder", type=Path, default=Path("exam"))
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    wanted = (number for number in count() if kind_of(SEED, number) in arguments.kinds)
    for number in islice(wanted, arguments.count):
        rgb, classes = scene(SEED, number, arguments.size)
        name = f"{kind_of(SEED, number)}_{number}.png"
        Image.fromarray(rgb).save(arguments.folder / name)
        write_mask(classes, arguments.folder / f"mask_{name}")


if __name__ == "__main__":
    main()
