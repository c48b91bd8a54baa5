"""Targets of the tasks similarities and compare: masks by the name of their picture."""

from __future__ import annotations

import glob
import os
from pathlib import Path

from omegaconf import DictConfig

from experiments.errors import UserError, blame
from experiments.extractor import build_extractor
from experiments.pictures import EXAMPLES, examples
from treefit.image import read_picture
from treefit.image.read import read_mask_file
from treefit.mask import Mask
from treefit.placing import place


def read_targets(pattern: str | None, extractor: DictConfig, setting: str = "similarities.masks") -> dict[str, Mask]:
    """Masks in the files that `pattern`, the value of `setting`, matches.

    None: those that `extractor` finds in the example pictures.
    """
    if pattern is None:
        find = build_extractor(extractor, "mask")
        return {Path(name).stem: find(read_picture(EXAMPLES / name)).mask for name in examples()}
    targets: dict[str, Mask] = {}
    for file in matching(pattern, setting):
        name = file.stem.removeprefix("mask_")
        if name in targets:
            raise UserError(f"{setting}: two files are named {name!r}; rename one, {file} for example")
        targets[name] = read_mask_file(file)
        with blame(f"{setting}: {file}"):
            place(targets[name])
    return targets


def matching(pattern: str, setting: str) -> list[Path]:
    """Files that `pattern`, the value of `setting`, matches, in order; UserError when none does."""
    found = glob.glob(os.path.expanduser(pattern), recursive=True)  # noqa: PTH111, PTH207  as in command_line.py
    files = sorted(Path(file) for file in found if Path(file).is_file())
    if not files:
        raise UserError(f"{setting}: no file matches {pattern!r}")
    return files
