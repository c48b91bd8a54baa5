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
        if mask.shape != picture.shape:
            self._check_aspect(mask.shape, picture.shape)
        resized = resize_mask(mask, picture.shape)
        return Extraction(resized, "file", 1.0, f"the mask file {self.path.name} was given", judge(resized))

    def _check_aspect(self, mask_shape: tuple[int, int], shape: tuple[int, int]) -> None:
        (height, width), (target_height, target_width) = mask_shape, shape
        if abs(width * target_height / (height * target_width) - 1) > ASPECT_TOLERANCE:
            raise PictureError(
                f"{self.path}: the mask is {width} x {height} pixels and the picture {target_width} x "
                f"{target_height}: their shapes differ; give a mask of the whole picture"
            )
