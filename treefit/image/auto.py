"""AutoMask: chooses the extractor that fits the picture and says which and why."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass
from skimage.color import rgb2gray, rgb2lab

from treefit.image.alpha import AlphaMask
from treefit.image.classes import is_strokes
from treefit.image.colour import ColourMask
from treefit.image.extraction import Extraction, Extractor
from treefit.image.network import NetworkMask
from treefit.image.onnx_model import NoRuntimeError
from treefit.image.picture import Picture, shrink
from treefit.image.plain import has_plain_border
from treefit.image.proposals import best_of
from treefit.image.sketch import SketchMask
from treefit.image.warnings import CURE, check_picture

LOOK_SIZE = 512
CLEAR_SHARE = 0.02
GREY_CHROMA = 8.0
GREY_SHARE = 0.97
PAPER = 0.75


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class AutoMask:
    """Alpha for a cut-out; colour, sketch or network, as the network judges, for a drawing; network for all others.

    Without onnxruntime it is sketch for grey ink on light paper and colour for all others. It warns when it is less
    sure than `sure`.
    """

    alpha: AlphaMask = Field(default_factory=AlphaMask)
    sketch: SketchMask = Field(default_factory=SketchMask)
    colour: ColourMask = Field(default_factory=ColourMask)
    network: NetworkMask = Field(default_factory=NetworkMask)
    sure: float = Field(default=0.75, ge=0, le=1)

    def __call__(self, picture: Picture) -> Extraction:
        """Extraction of the chosen method; `why` says why it was chosen."""
        check_picture(picture)
        look = shrink(picture, LOOK_SIZE)
        inked = _is_ink(look)
        if _has_cutout(look, self.alpha.threshold) and not (inked and _is_drawn_in_lines(look, self.alpha.threshold)):
            return _because(self.alpha(picture), "the picture has transparent parts")
        try:
            return self._unsure(self._by_network(picture, has_plain_border(look.rgb), inked))
        except NoRuntimeError as error:
            return self._without_network(picture, inked, str(error))

    def _by_network(self, picture: Picture, plain: bool, inked: bool) -> Extraction:
        if not plain:
            return _because(self.network(picture), "a photograph")
        ways: Sequence[Extractor] = (self.sketch, self.colour) if inked else (self.colour,)
        kind = "grey ink on light paper" if inked else "a plain ground"
        return _because(best_of(picture, ways, self.network), kind)

    def _without_network(self, picture: Picture, inked: bool, reason: str) -> Extraction:
        if inked:
            return _because(self.sketch(picture), "grey ink on light paper")
        found = _because(self.colour(picture), "neither transparent nor a drawing in grey")
        return replace(found, warnings=(f"{reason}; until then colours have to do", *found.warnings))

    def _unsure(self, found: Extraction) -> Extraction:
        if found.confidence >= self.sure:
            return found
        doubt = f"unsure of the tree ({found.confidence:.0%}): look at mask_overlay.png, and if it is wrong, {CURE}"
        return replace(found, warnings=(doubt, *found.warnings))


def _has_cutout(picture: Picture, threshold: int) -> bool:
    if picture.alpha is None:
        return False
    clear = float((picture.alpha < threshold).mean())
    return clear > CLEAR_SHARE


def _is_ink(picture: Picture) -> bool:
    """Whether the picture is without colour and its border is light and plain."""
    lab = rgb2lab(picture.rgb)
    grey = (np.hypot(lab[..., 1], lab[..., 2]) < GREY_CHROMA).mean() > GREY_SHARE
    border = rgb2gray(np.concatenate((picture.rgb[0], picture.rgb[:, 0], picture.rgb[:, -1]))[None])
    return bool(grey and np.median(border) > PAPER and has_plain_border(picture.rgb))


def _is_drawn_in_lines(picture: Picture, threshold: int) -> bool:
    """Whether the opaque part is mere strokes, whose inside is transparent."""
    assert picture.alpha is not None
    opaque = picture.alpha >= threshold
    return bool(opaque.any()) and is_strokes(opaque)


def _because(extraction: Extraction, reason: str) -> Extraction:
    return replace(extraction, why=f"{reason}; {extraction.why}")
