"""The tree of a run: its picture, and the mask that the extractor of the configuration finds in it."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from omegaconf import DictConfig
from PIL import Image

from experiments.extractor import build_extractor
from treefit.asset import TreeColours
from treefit.asset.material.image_colours import image_colours
from treefit.image import Extraction, Picture, overlay, read_picture, write_mask
from treefit.image.picture import shrink
from treefit.image.resize import resize_mask

SHOWN = 2048
"""Pixels of the longer side of mask_overlay.png at most: it is to be looked at."""

_log = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class ReadTree:
    """A picture by name, and the mask found in it."""

    name: str
    picture: Picture
    extraction: Extraction

    @cached_property
    def colours(self) -> TreeColours:
        """Colours of bark and leaves that the picture shows."""
        return image_colours(self.picture.rgb, self.extraction.mask)

    @property
    def warnings(self) -> list[str]:
        """What the user should know about the picture and the mask."""
        return [*self.picture.notes, *self.extraction.warnings]


def read_tree(cfg: DictConfig, folder: Path) -> ReadTree:
    """Read cfg.image, find the tree, write mask.png and mask_overlay.png to `folder`, say every warning."""
    picture = read_picture(cfg.image)
    extraction = build_extractor(cfg.mask, "mask")(picture)
    write_mask(extraction.mask, folder / "mask.png")
    shown = shrink(picture, SHOWN)
    Image.fromarray(overlay(shown, resize_mask(extraction.mask, shown.shape))).save(folder / "mask_overlay.png")
    tree = ReadTree(Path(cfg.image).name, picture, extraction)
    for warning in tree.warnings:
        _log.warning(warning)
    _log.info("mask=%s: %s", extraction.method, extraction.why)
    return tree
