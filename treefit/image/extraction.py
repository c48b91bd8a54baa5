"""Extraction: a mask found in a picture, with how and why; Extractor: anything that finds one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from treefit.image.picture import Picture
from treefit.mask import Mask


@dataclass(frozen=True, eq=False)
class Extraction:
    """Mask of the size of the picture, the method that found it, its confidence in [0, 1] and one line of reason."""

    mask: Mask
    method: str
    confidence: float
    why: str
    warnings: tuple[str, ...] = ()


class Extractor(Protocol):
    """Finds the tree in a picture."""

    def __call__(self, picture: Picture) -> Extraction:
        """Extraction whose mask has the size of `picture`; PictureError when there is no tree to find."""
