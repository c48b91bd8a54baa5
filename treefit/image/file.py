"""FileMask: the mask that the user gives as a file; nothing in the picture is looked at."""

from __future__ import annotations

from pathlib import Path

from pydantic import ConfigDict
from pydantic.dataclasses import dataclass

from treefit.image.extraction import Extraction
from treefit.image.picture import Picture
from treefit.image.read import PictureError, read_mask_file
from treefit.image.resize import resize_mask
from treefit.image.warnings import judge

ASPECT_TOLERANCE = 0.02


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class FileMask:
    """Mask read from `path` (pixel values 0, 1, 2), resized to the picture when only the scale differs."""

    path: Path

    def __call__(self, picture: Picture) -> Extraction:
        """Extraction with the user's mask."""
        mask = read_mask_file(self.path)
        check_aspect("mask", self.path, mask.shape, picture.shape)
        resized = resize_mask(mask, picture.shape)
        return Extraction(resized, "file", 1.0, f"the mask file {self.path.name} was given", judge(resized))


def check_aspect(what: str, path: Path, own: tuple[int, int], shape: tuple[int, int]) -> None:
    """PictureError when a file of size `own` (h, w) cannot belong to a picture of `shape`, whatever their scales."""
    (height, width), (target_height, target_width) = own, shape
    if abs(width * target_height / (height * target_width) - 1) > ASPECT_TOLERANCE:
        raise PictureError(
            f"{path}: the {what} is {width} x {height} pixels and the picture {target_width} x "
            f"{target_height}: their shapes differ; give a {what} of the whole picture"
        )
