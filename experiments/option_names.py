"""Names of options: which file of conf a group's settings are, however they came to be."""

from __future__ import annotations

from omegaconf import DictConfig, OmegaConf

from experiments.command_check import CONFIG_FOLDER


def option_name(group: str, node: DictConfig) -> str | None:
    """Name of the file in conf/<group> that says the same as `node`; None when a setting was changed."""
    for file in sorted((CONFIG_FOLDER / group).glob("*.yaml")):
        if OmegaConf.load(file) == node:
            return file.stem
    return None
