"""NetworkMask: the tree as a small neural network sees it, ours or the user's."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass
from skimage.color import rgb2lab

from treefit.image.belief import Belief, believe, expected_overlap, finer, resized
from treefit.image.classes import by_form
from treefit.image.extraction import Extraction
from treefit.image.kinds import kinds
from treefit.image.onnx_model import ModelError, fixed_sides, run_model
from treefit.image.picture import Picture, Rgb, shrink
from treefit.image.plain import has_plain_border
from treefit.image.refine import refine
from treefit.image.resize import resize_mask
from treefit.image.sky import find_sky
from treefit.image.warnings import check_picture, judge
from treefit.mask import BACKGROUND

OURS = Path(__file__).with_name("tree.onnx")
MULTIPLE = 64
"""Sides of the pictures that a network gets are multiples of this: six halvings, as deep as such networks go."""

SKY_SIZE = 256
"""Pixels at which the colours of the sky are looked at: finer is slower and not better."""

ClassName = Literal["background", "branch", "foliage", "tree"]
Deviation = Annotated[float, Field(gt=0)]


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class NetworkMask:
    """A network at `size` pixels of the longer side; its answer is carried to the picture's own edges.

    With `clean` its answer to a photograph is one among others: colours, the sky and one connected tree count too.
    The network gets (x - mean) / std of each pixel, x in 0..1, and gives a channel for each name of `classes`, logits
    or probabilities. Channels of one name are added up; `tree` is wood and leaves alike, told apart by shape then.
    """

    model: Path | None = None
    size: int = Field(default=256, ge=64, le=2048)
    mean: tuple[float, float, float] = (0.0, 0.0, 0.0)
    std: tuple[Deviation, Deviation, Deviation] = (1.0, 1.0, 1.0)
    classes: tuple[ClassName, ...] = ("background", "branch", "foliage")
    mirror: bool = True
    clean: bool = True
    threshold: float = Field(default=0.5, gt=0, lt=1)
    fine: int = Field(default=1024, ge=64, le=4096)
    sky: float = Field(default=0.95, gt=0, le=1)
    edge: int = Field(default=8, ge=1, le=64)

    def __post_init__(self) -> None:
        if not {"branch", "foliage", "tree"} & set(self.classes):
            raise ValueError(f"classes must name what is tree: branch, foliage or tree; got {list(self.classes)}")
        if len(self.classes) > 1 and "background" not in self.classes:
            raise ValueError(f"classes must name the channel of the background; got {list(self.classes)}")

    def __call__(self, picture: Picture) -> Extraction:
        """Extraction of what the network holds for tree."""
        check_picture(picture)
        return self.judged(picture, self.belief(picture))

    def judged(self, picture: Picture, seen: Belief) -> Extraction:
        """Extraction of what the network holds for tree, when `seen` is its belief."""
        fine, look = shrink(picture, self.fine).rgb, shrink(picture, SKY_SIZE).rgb
        plain = has_plain_border(look)
        if self.clean and not plain:
            belief, tree = resized(seen, fine.shape[:2]), refine(seen, picture, fine)
        else:
            belief = finer(seen, fine, self.edge)
            # the paper of a drawing shows inside its outlines
            needed = self.threshold if plain else self._needed(look, belief.shape[:2])
            tree = 1 - belief[..., BACKGROUND] >= needed
        mask = kinds(fine, tree, belief) if "branch" in self.classes else by_form(tree)
        sure = expected_overlap(belief, mask)
        mask = resize_mask(mask, picture.shape)
        why = f"a network found it and expects {sure:.0%} of the tree to be right"
        return Extraction(mask, "network", sure, why, judge(mask))

    def belief(self, picture: Picture) -> Belief:
        """Probabilities (h, w, 3) of background, branch, foliage at the size at which the network works."""
        path = self.model or OURS
        height, width = fixed_sides(path) or _sides(picture.shape, self.size)
        small = Image.fromarray(picture.rgb).resize((width, height), Image.Resampling.BILINEAR)
        pixels = ((np.asarray(small) / 255.0 - self.mean) / self.std).astype(np.float32)
        belief = self._ask(path, pixels)
        if self.mirror:
            belief = (belief + self._ask(path, pixels[:, ::-1])[:, ::-1]) * np.float32(0.5)
        return belief

    def _needed(self, look: Rgb, shape: tuple[int, int]) -> NDArray[np.float32]:
        """(h, w) of `shape`: probability from which a pixel is tree, more in what looks like sky."""
        sky = resize_mask(find_sky(rgb2lab(look)).astype(np.uint8), shape)
        return np.where(sky > 0, max(self.sky, self.threshold), self.threshold).astype(np.float32)

    def _ask(self, path: Path, pixels: NDArray[np.float32]) -> Belief:
        channels = run_model(path, pixels)
        if len(channels) != len(self.classes):
            raise ModelError(
                f"{path}: gives {len(channels)} channels, and mask.classes names {len(self.classes)}: "
                f"{', '.join(self.classes)}; name each channel background, branch, foliage or tree"
            )
        return believe(channels, self.classes)


def _sides(shape: tuple[int, int], size: int) -> tuple[int, int]:
    """Height and width with about the proportions of `shape`, multiples of 64, the longer `size` rounded down."""
    longest = max(shape)
    height, width = (max(1, round(side * size / longest / MULTIPLE)) * MULTIPLE for side in shape)
    return height, width
