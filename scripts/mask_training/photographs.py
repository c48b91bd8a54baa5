"""Photographs with reference masks: only to measure a network that is done, never to train or to choose it."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from scripts.mask_training.validation import NAMES, iou
from treefit.image.extraction import Extractor
from treefit.image.picture import Picture
from treefit.image.read import read_mask_file, read_picture
from treefit.mask import BACKGROUND, BRANCH, Mask


@dataclass(frozen=True)
class Row:
    """Scores of one photograph."""

    name: str
    tree: float
    classes: float
    branch: float
    seconds: float


def pairs(pattern: str) -> list[tuple[Path, Path]]:
    """Pictures of `pattern` that have a reference mask_<name>.png beside them."""
    paths = sorted(Path(pattern).parent.glob(Path(pattern).name))
    found = [(path, path.with_name(f"mask_{path.stem}.png")) for path in paths]
    return [(path, mask) for path, mask in found if mask.exists()]


def measure(extractor: Extractor, pattern: str) -> Iterator[Row]:
    """Yield the scores of each photograph of `pattern` that has a reference mask, last their means."""
    rows = []
    for path, reference in pairs(pattern):
        picture, expected = read_picture(path), read_mask_file(reference)
        rows.append(_row(extractor, path.stem, picture, expected))
        yield rows[-1]
    if rows:
        yield Row("mean", *(sum(getattr(row, name) for row in rows) / len(rows) for name in Row.__match_args__[1:]))


def _row(extractor: Extractor, name: str, picture: Picture, expected: Mask) -> Row:
    begin = time.process_time()
    found = extractor(picture).mask
    seconds = time.process_time() - begin
    each = [iou(found == index, expected == index) for index in NAMES.values()]
    tree = iou(found != BACKGROUND, expected != BACKGROUND)
    return Row(name, tree, sum(each) / len(each), each[BRANCH], seconds)
