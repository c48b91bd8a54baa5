"""Task masks: what the extractors make of many pictures, measured where there are masks made by hand, and by eye."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, cast

import numpy as np
from hydra import compose
from hydra.core.hydra_config import HydraConfig
from omegaconf import DictConfig
from PIL import Image

from experiments.command_check import CONFIG_FOLDER
from experiments.errors import UserError, did_you_mean
from experiments.extractor import build_extractor
from experiments.masks_measure import Found
from experiments.masks_page import means, page
from experiments.masks_sheet import sheet
from experiments.numbers import rounded
from experiments.pictures import EXAMPLES, examples
from experiments.run_folder import run_folder
from experiments.settings import read_settings
from experiments.similarities_targets import matching
from treefit.image import Extractor, read_picture
from treefit.image.picture import Picture
from treefit.image.read import PictureError, read_mask_file
from treefit.mask import Mask


def run(cfg: DictConfig) -> None:
    """Write masks.md, masks.json and masks.png of the pictures and extractors of cfg.masks."""
    folder, wanted = run_folder(), read_settings(cfg).masks
    extractors = _extractors(wanted.methods, cfg.mask)
    pictures = _pictures(wanted.pictures)
    references = _references(wanted.references, pictures)
    found: list[Found] = []
    for i, (name, picture) in enumerate(pictures.items(), start=1):
        for method, extractor in extractors.items():
            one = Found.of(name, picture, method, extractor, references.get(name))
            found.append(one)
            print(f"{i}/{len(pictures)} {name} by {method}: {_told(one)}", file=sys.stderr, flush=True)
    text = page(found, [str(one) for one in HydraConfig.get().overrides.task])
    (folder / "masks.md").write_text(text, encoding="utf-8")
    Image.fromarray(sheet(pictures, found)).save(folder / "masks.png", optimize=True)
    facts = {method: means(method, found) for method in extractors}
    (folder / "masks.json").write_text(json.dumps(rounded(facts, 4), indent=1), encoding="utf-8")
    files = {"table": str(folder / "masks.md"), "sheet": str(folder / "masks.png")}
    print(json.dumps({**files, **cast(dict[str, Any], rounded(facts, 4))}), flush=True)


def _extractors(names: Sequence[str] | None, configured: DictConfig) -> dict[str, Extractor]:
    """Extractors by name: those in conf, or the configured one alone."""
    if names is None:
        return {str(HydraConfig.get().runtime.choices["mask"]): build_extractor(configured, "mask")}
    known = [file.stem for file in (CONFIG_FOLDER / "mask").glob("*.yaml")]
    found = {}
    for name in names:
        if name not in known:
            raise UserError(f"masks.methods: no mask {name!r}{did_you_mean(name, known)}")
        node = compose(config_name="config", overrides=[f"mask={name}"]).mask
        found[name] = build_extractor(node, f"masks.methods: {name}")
    return found


def _pictures(pattern: str | None) -> dict[str, Picture]:
    """Pictures by name without ending; the example pictures when there is no pattern."""
    files = [EXAMPLES / name for name in examples()] if pattern is None else matching(pattern, "masks.pictures")
    found: dict[str, Picture] = {}
    for file in files:
        if not file.stem.startswith("mask_") and file.suffix.lower() not in (".json", ".md", ".txt"):
            found[file.stem if file.stem not in found else file.name] = read_picture(file)
    if not found:
        raise UserError(f"masks.pictures: no picture matches {pattern!r}")
    return found


def _references(pattern: str | None, pictures: dict[str, Picture]) -> dict[str, Mask]:
    """Masks made by hand, by the name of their picture: mask_oak.png is that of oak.jpg."""
    files = [] if pattern is None else matching(pattern, "masks.references")
    found: dict[str, Mask] = {}
    for file in files:
        name = file.stem.removeprefix("mask_")
        if name in pictures:
            found[name] = _fitting(file, pictures[name])
    return found


def _fitting(file: Path, picture: Picture) -> Mask:
    mask = read_mask_file(file)
    if mask.shape != picture.shape:
        raise PictureError(
            f"{file}: must have the size of its picture, (height, width) {picture.shape}, got {mask.shape}"
        )
    return np.ascontiguousarray(mask)


def _told(one: Found) -> str:
    if one.extraction is None:
        return f"no mask: {one.error}"
    told = one.agreement
    numbers = "" if told is None else f"tree {told['tree']:.2f}, classes {told['classes']:.2f}, "
    return f"{numbers}{one.extraction.method}, sure {one.extraction.confidence:.2f}, {one.seconds:.2f} s"
