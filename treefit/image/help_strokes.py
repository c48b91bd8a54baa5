"""Strokes: what a user painted in green, brown and red on a copy of the picture, or on white or clear ground."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image
from scipy import ndimage
from skimage.color import rgb2lab

from treefit.image.file import check_aspect
from treefit.image.help_odds import NOT_TREE
from treefit.image.picture import Picture, Region, Rgb, shrink
from treefit.image.read import PictureError, read_picture
from treefit.image.resize import resize_mask, resize_strokes
from treefit.image.sky import Lab
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, PALETTE, Mask

PAINTS: dict[int, tuple[tuple[int, int, int], ...]] = {
    FOLIAGE: ((0, 255, 0), (0, 128, 0), (0, 190, 0), (34, 177, 76), (0, 166, 80), (50, 205, 50), PALETTE[FOLIAGE]),
    BRANCH: ((139, 69, 19), (165, 42, 42), (150, 75, 0), (102, 51, 0), (185, 122, 87), (128, 64, 0), PALETTE[BRANCH]),
    NOT_TREE: ((255, 0, 0), (237, 28, 36), (220, 20, 60), (200, 0, 0)),
}
"""Greens, browns and reds as paint programs offer them."""

SIZE, LOOP_SIZE = 2048, 512
SAME_PAINT, DIFFERS, WHITE = 18.0, 14.0, 6.0
"""Distances in Lab: of a stroke to its paint, from the picture under it, of white ground to white."""

NOISE = 7
"""Pixels around in which a copy that was saved as JPEG or at another size may find its colours."""

LEAST_ALIKE, LEAST_GROUND = 0.4, 0.5
LEAST_STROKE, LEAST_FOREIGN = 8, 0.0005
GAP, LEAST_LOOP, LOOP_OF_STROKE = 0.008, 0.01, 3.0
WHAT_TO_PAINT = "paint the tree green (0, 160, 0), its trunk brown (139, 69, 19), what is not the tree red (255, 0, 0)"


@dataclass(frozen=True, eq=False)
class Strokes:
    """`marks` (h, w): BRANCH, FOLIAGE, NOT_TREE, BACKGROUND where nothing is painted; inside of closed green lines."""

    marks: Mask
    outline: Region | None


def read_strokes(path: Path, picture: Picture) -> Strokes:
    """Strokes at the size of `picture`; what closed brown and red lines enclose is painted as well.

    PictureError when the file is neither a copy of the picture nor strokes on a clear ground, or without strokes.
    """
    hint = read_picture(path)
    check_aspect("hint", path, hint.shape, picture.shape)
    marks = _painted(path, shrink(hint, SIZE), picture)
    filled, outline = marks.copy(), np.zeros(marks.shape, dtype=bool)
    for paint in (BRANCH, NOT_TREE):
        filled[_enclosed(marks == paint) & (marks == BACKGROUND)] = paint
    if (marks == FOLIAGE).any():
        outline = _enclosed(marks == FOLIAGE)
        filled[_line_around(outline, marks == FOLIAGE)] = BACKGROUND
    inside = resize_mask(outline.astype(np.uint8), picture.shape).astype(bool) if outline.any() else None
    return Strokes(resize_strokes(filled, picture.shape), inside)


def _painted(path: Path, hint: Picture, picture: Picture) -> Mask:
    """(h, w) of `hint`: what is painted on it."""
    height, width = hint.shape
    below = np.asarray(Image.fromarray(picture.rgb).resize((width, height), Image.Resampling.BOX))
    lab = rgb2lab(hint.rgb)
    differs = _differs(lab, rgb2lab(below), _is_exact(hint.rgb, below))
    if differs.mean() > 1 - LEAST_ALIKE:
        differs = np.linalg.norm(lab - (100, 0, 0), axis=-1) > WHITE
        if differs.mean() > 1 - LEAST_GROUND:
            raise PictureError(f"{path}: the hint is no copy of the picture, nor strokes on white or clear ground")
    marks = np.where(differs, _paints(lab), BACKGROUND).astype(np.uint8)
    for paint in PAINTS:
        marks[_specks(marks == paint)] = BACKGROUND
    if not marks.any():
        foreign = differs.mean() > LEAST_FOREIGN
        found = "has no strokes in the right colours" if foreign else "is the picture itself, nothing is painted on it"
        raise PictureError(f"{path}: the hint {found}; {WHAT_TO_PAINT}")
    return marks


def _is_exact(rgb: Rgb, below: Rgb) -> bool:
    """Whether the pixels of `rgb` are those of `below` as they were, where not all are alike anyway."""
    sides = (3, 3, 1)
    textured = (ndimage.maximum_filter(below, sides) != ndimage.minimum_filter(below, sides)).any(axis=-1)
    return bool((rgb == below).all(axis=-1)[textured].mean() > LEAST_ALIKE) if textured.any() else True


def _differs(lab: Lab, below: Lab, exact: bool) -> Region:
    """(h, w) bool: pixels of other colours than the picture `below` has there; unless `exact`, than it has around."""
    reach = 1 if exact else NOISE
    sides = (reach, reach, 1)
    low, high = ndimage.minimum_filter(below, sides), ndimage.maximum_filter(below, sides)
    return np.asarray(np.linalg.norm(lab - np.clip(lab, low, high), axis=-1) > DIFFERS)


def _paints(lab: Lab) -> Mask:
    """(h, w): class of the paint that each pixel is nearly of, BACKGROUND where it is of none."""
    marks = np.full(lab.shape[:2], BACKGROUND, np.uint8)
    nearest = np.full(lab.shape[:2], SAME_PAINT)
    for kind, colours in PAINTS.items():
        for colour in rgb2lab(np.array([colours], np.uint8))[0]:
            distance = np.linalg.norm(lab - colour, axis=-1)
            marks[distance < nearest] = kind
            nearest = np.minimum(distance, nearest)
    return marks


def _specks(paint: Region) -> Region:
    """(h, w) bool: parts of `paint` of so few pixels that they are noise of a JPEG file."""
    labels, _ = ndimage.label(paint, structure=np.ones((3, 3)))
    few = np.bincount(labels.ravel()) < LEAST_STROKE
    few[0] = False
    return np.asarray(few[labels])


def _line_around(outline: Region, paint: Region) -> Region:
    """(h, w) bool: the parts of `paint` that go around `outline`: an outline is no stroke."""
    labels, _ = ndimage.label(paint, structure=np.ones((3, 3)))
    rim = ndimage.binary_dilation(outline, iterations=3) & ~outline
    around = np.unique(labels[rim & paint])
    return np.asarray(np.isin(labels, around[around > 0]))


def _enclosed(paint: Region) -> Region:
    """(h, w) bool: inside of lines that close, up to a gap; small loops of a scribble do not count."""
    longest = max(paint.shape)
    shape = (max(1, paint.shape[0] * LOOP_SIZE // longest), max(1, paint.shape[1] * LOOP_SIZE // longest))
    small = resize_strokes(paint.astype(np.uint8), shape) > 0 if longest > LOOP_SIZE else paint
    reach = max(1.0, GAP * max(small.shape))
    wide = ndimage.distance_transform_edt(~small) <= reach if small.any() else small
    labels, _ = ndimage.label(ndimage.binary_fill_holes(wide) & ~wide)
    areas = np.bincount(labels.ravel())
    least = max(LEAST_LOOP * small.size, LOOP_OF_STROKE * small.sum())
    large = areas >= least
    large[0] = False
    if not large.any():
        return np.zeros_like(paint)
    inside = ndimage.distance_transform_edt(~large[labels]) <= reach + 1
    return np.asarray(resize_mask(inside.astype(np.uint8), paint.shape).astype(bool))
