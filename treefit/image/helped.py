"""HelpedMask: any extractor, with what the user says of the picture."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from skimage.draw import polygon2mask

from treefit.image.extraction import Extraction, Extractor
from treefit.image.help import Help, Points, Window
from treefit.image.help_classes import classify
from treefit.image.help_cut import cut_tree, surroundings
from treefit.image.help_odds import Said
from treefit.image.help_point import look_at, part_at
from treefit.image.help_strokes import read_strokes
from treefit.image.picture import Picture, Region, cut_out, shrink
from treefit.image.read import NoTreeError, PictureError
from treefit.image.resize import resize_mask, resize_strokes
from treefit.image.warnings import judge
from treefit.mask import Mask

SIZE = 1536
"""Pixels of the longer side at which outline and strokes are followed."""

BY_OUTLINE, BY_STROKES = 0.9, 0.8
"""Confidence in a mask that the user has led."""


@dataclass(frozen=True)
class HelpedMask:
    """`extractor` looks at the crop only, outline and strokes correct it, the part at the point is taken.

    With an outline or strokes the extractor may find nothing.
    """

    extractor: Extractor
    help: Help

    def __call__(self, picture: Picture) -> Extraction:
        """Extraction of the whole picture; PictureError when the help does not suit it."""
        window, point = self.help.window(picture.shape), self.help.pixel(picture.shape)
        part = cut_out(picture, *window)
        at = None if point is None else (point[0] - window[0].start, point[1] - window[1].start)
        if self.help.outline is not None or self.help.hint is not None:
            found = self._led(part, picture, window)
        else:
            found = self.extractor(part) if at is None else look_at(part, at, self.extractor)
        if at is not None:
            found = replace(found, mask=part_at(found.mask, at), why=f"the part at your point; {found.why}")
        warnings = judge(found.mask)
        mask = np.zeros(picture.shape, np.uint8)
        mask[window] = found.mask
        if self.help.crop is not None:
            warnings = tuple(warning.replace("of the picture", "of mask.crop") for warning in warnings)
            found = replace(found, why=f"inside mask.crop; {found.why}")
        return replace(found, mask=mask, warnings=warnings)

    def _led(self, part: Picture, picture: Picture, window: Window) -> Extraction:
        """Extraction of `part`, the `window` of `picture`: what is drawn leads, the extractor's own answer helps."""
        look = shrink(part, SIZE)
        outline, strokes = self._drawn(picture, window, look.shape)
        found = self._around(part, surroundings(outline, look.shape), look.shape)
        said = Said(resize_mask(found.mask, look.shape), outline, strokes)
        mask = resize_mask(classify(look, cut_tree(look, said), said), part.shape)
        ways = {"inside your outline": outline, "by your strokes": strokes}
        why = " and ".join(way for way, drawn in ways.items() if drawn is not None)
        sure = BY_STROKES if outline is None else BY_OUTLINE
        return replace(found, mask=mask, confidence=max(sure, found.confidence), why=f"{why}; {found.why}")

    def _around(self, part: Picture, near: Window, shape: tuple[int, int]) -> Extraction:
        """Extraction of `part` by what the extractor finds in `near`, a window of `part` at `shape`."""
        rows, columns = (_scaled(span, size, side) for span, size, side in zip(near, shape, part.shape, strict=True))
        mask = np.zeros(part.shape, np.uint8)
        try:
            found = self.extractor(cut_out(part, rows, columns))
        except NoTreeError:
            return Extraction(mask, "help", 0.0, "nothing was found without your help")
        mask[rows, columns] = found.mask
        return replace(found, mask=mask)

    def _drawn(self, picture: Picture, window: Window, shape: tuple[int, int]) -> tuple[Region | None, Mask | None]:
        """Inside of the outline and strokes in the `window` of `picture` at `shape`, each None when there are none."""
        outline, strokes = None, None
        corners = self.help.polygon(picture.shape)
        if corners is not None:
            outline = _filled(corners, window, shape)
        if self.help.hint is not None:
            painted = read_strokes(self.help.hint, picture)
            strokes = resize_strokes(painted.marks[window], shape)
            if painted.outline is not None:
                loops = resize_mask(painted.outline[window].astype(np.uint8), shape).astype(bool)
                outline = loops if outline is None else outline | loops
        if outline is not None and not outline.any():
            raise PictureError(f"mask.outline: {'is outside mask.crop' if self.help.crop else 'has no inside'}")
        return outline, strokes


def _scaled(span: slice, size: int, side: int) -> slice:
    """`span` of `size` pixels as part of `side` pixels."""
    return slice(span.start * side // size, -(-span.stop * side // size))


def _filled(corners: Points, window: Window, shape: tuple[int, int]) -> Region:
    """(h, w) bool of `shape`: inside of the polygon, as far as it is in the `window`."""
    start = np.array([window[1].start, window[0].start])
    size = np.array([window[1].stop, window[0].stop]) - start
    scaled = (corners - start) * np.array(shape[::-1]) / size
    return np.asarray(polygon2mask(shape, scaled[:, ::-1] - 0.5))
