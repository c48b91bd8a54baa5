"""Dressing: bark and leaves that suit the picture of a run, and how a preset keeps them for `task=grow`."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import asdict, replace

from omegaconf import DictConfig, OmegaConf
from pydantic import TypeAdapter, ValidationError

from experiments.errors import UserError, describe_validation
from experiments.read_tree import ReadTree
from treefit.asset import AssetSettings, TreeColours
from treefit.image.habit import is_cone

LEFT_OPEN: Mapping[str, str | None] = {"bark": None, "leaf": None, "leaf_outline": "auto", "bark_kind": "auto"}
"""Settings of the asset that a preset may hold, and their values when the user has not chosen."""

_log = logging.getLogger(__name__)


def suited(cfg: DictConfig, tree: ReadTree) -> DictConfig:
    """Return `cfg` with tufts of needles for a crown like a cone, unless the user chose other leaves."""
    if cfg.asset.get("leaf_outline") != "auto" or not is_cone(tree.extraction.mask):
        return cfg
    _log.info("asset.leaf_outline=tuft: the crown widens steadily from a narrow top, as a conifer's does")
    changed = OmegaConf.create(OmegaConf.to_container(cfg, resolve=False))
    assert isinstance(changed, DictConfig)
    for group in (changed.asset, changed.characteristics):  # which counts the triangles of that mesh
        if group.get("leaf_outline") == "auto":
            group.leaf_outline = "tuft"
    return changed


def look_of(asset: AssetSettings, seen: TreeColours) -> dict[str, str]:
    """Return what a preset keeps of the look of a tree: what was chosen, and the colours of the picture."""
    if asset.colours == "from_image":
        asset = replace(asset, bark=asset.bark or seen.bark, leaf=asset.leaf or seen.leaf)
    chosen = {name: getattr(asset, name) for name, left in LEFT_OPEN.items() if getattr(asset, name) != left}
    return {name: value if isinstance(value, str) else "#{:02x}{:02x}{:02x}".format(*value)
            for name, value in chosen.items()}  # fmt: skip


def dressed(asset: AssetSettings, look: Mapping[str, str]) -> AssetSettings:
    """Return `asset` with the `look` of a preset, where the user has not chosen; UserError for what it cannot hold."""
    unknown = [name for name in look if name not in LEFT_OPEN]
    if unknown:
        raise UserError(f"preset: look has {unknown[0]!r}; it may have {', '.join(LEFT_OPEN)}")
    kept = {name: value for name, value in look.items() if getattr(asset, name) == LEFT_OPEN[name]}
    try:
        return TypeAdapter(AssetSettings).validate_python({**asdict(asset), **kept})
    except ValidationError as error:
        raise UserError(describe_validation(error, "preset: look")) from error
