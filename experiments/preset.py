"""The setting `preset`: a file, as written beside every candidate, or the name of one of the generator's own plants."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import replace
from pathlib import PurePath
from typing import cast

from hydra.core.hydra_config import HydraConfig
from omegaconf import DictConfig, OmegaConf

from experiments.errors import UserError, blame, did_you_mean
from experiments.pictures import find_file, is_file
from treefit.plant import Generator, Preset, Value, read_preset

_log = logging.getLogger(__name__)


def find_preset(name: str, generator: Generator, place: str = "preset") -> Preset:
    """Return the preset `name` with values that `generator` takes; a file comes before a plant of that name.

    UserError with one line, which begins with the setting `place`, when it is neither, or of another generator.
    """
    own = generator.presets
    if is_file(name) or (name not in own and _is_path(name)):
        preset = _read(name, generator, place)
    elif name in own:
        preset = replace(own[name], version=generator.version)  # a generator comes with presets that fit it
    else:
        raise UserError(f"{place}: neither a file nor a plant of {generator.name}: {name!r}{did_you_mean(name, own)}")
    with blame(f"{place}: {name}"):
        generator.space.complete(preset.values)
    return preset


def wanted_plant(cfg: DictConfig, generator: Generator) -> tuple[dict[str, Value], int, Mapping[str, str]]:
    """Values by name, seed and look: those of cfg.preset, then what the command line sets."""
    given = cast(dict[str, Value], OmegaConf.to_container(cfg["values"], resolve=True))
    seed, look = int(cfg.seed), cast(Mapping[str, str], {})
    if cfg.preset is not None:
        preset = find_preset(str(cfg.preset), generator)
        warn_of_version(preset, generator)
        given, look = {**preset.values, **given}, preset.look
        if not any(line.startswith("seed=") for line in HydraConfig.get().overrides.task):
            seed = preset.seed
    with blame("values"):
        return generator.space.complete(given), seed, look


def warn_of_version(preset: Preset, generator: Generator) -> None:
    """Say it when `preset` was made by another version of `generator`."""
    if preset.version != generator.version:
        _log.warning("the preset is of version %s of %s, this is %s: the tree may differ", preset.version,
                     generator.name, generator.version)  # fmt: skip


def _read(name: str, generator: Generator, place: str) -> Preset:
    with blame(place):
        preset = read_preset(find_file(name, place))
    if preset.generator != generator.name:
        raise UserError(f"{place}: it was made by {preset.generator}; add generator={preset.generator}")
    return preset


def _is_path(name: str) -> bool:
    return PurePath(name).suffix != "" or len(PurePath(name).parts) > 1
