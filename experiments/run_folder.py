"""The folder of a run: where it is, its settings in config.yaml, and how it goes when nothing came of it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from hydra.core.hydra_config import HydraConfig
from hydra.types import RunMode
from omegaconf import DictConfig, OmegaConf

from experiments.errors import UserError
from experiments.pictures import absolute, find_file, is_file
from experiments.start_settings import listed

CHANGED_ON_RESUME = ("tracking", "evaluator", "stop", "debug", "live")


def run_folder() -> Path:
    """Absolute folder of the run that is going on."""
    return Path(HydraConfig.get().runtime.output_dir)


def candidate_folder(folder: Path, number: int) -> Path:
    """Folder of candidate `number` (from 1) in that of the run."""
    return folder / "candidates" / str(number)


def in_sweep() -> bool:
    """Whether the run is one of a sweep."""
    return bool(HydraConfig.get().mode == RunMode.MULTIRUN)


def settle(cfg: DictConfig, given: Sequence[str]) -> DictConfig:
    """`cfg` with absolute paths; that of the earlier run when it is resumed, but for what is `given` anew.

    `given` are the settings of the command line, "name=value". UserError when a file is missing.
    """
    settled = OmegaConf.create(OmegaConf.to_container(cfg, resolve=False))
    assert isinstance(settled, DictConfig)
    if cfg.get("resume"):
        settled = _resumed(settled, given)
    OmegaConf.set_struct(settled, True)
    for group, key in (("", "image"), ("", "preset"), ("mask", "path"), ("mask", "hint"), ("adapt", "example")):
        node = settled.get(group, {}) if group else settled
        if node.get(key) and (key != "preset" or is_file(str(node[key]))):  # else it is one of the generator's own
            node[key] = str(find_file(str(node[key]), f"{group}.{key}".strip(".")))
    if settled.get("start"):
        settled.start = [absolute(str(name)) for name in listed(settled.start)]
    if settled.get("memory") and settled.memory.use:
        settled.memory.folder = str(Path(settled.memory.folder).absolute())
    return settled


def save_config(cfg: DictConfig, folder: Path) -> None:
    """Write the whole resolved configuration to folder/config.yaml, at once or not at all."""
    unfinished = folder / "config.yaml.tmp"
    unfinished.write_text(OmegaConf.to_yaml(cfg, resolve=True), encoding="utf-8")
    unfinished.replace(folder / "config.yaml")


def discard(folder: Path) -> None:
    """Remove the folder of a run that could not begin, and outputs/ too when nothing else is in it."""
    chosen_by_user = any(line.startswith("hydra.run.dir=") for line in HydraConfig.get().overrides.hydra)
    for empty in [folder] if chosen_by_user else [folder, folder.parent]:
        if not empty.is_dir() or any(empty.iterdir()):
            return
        empty.rmdir()


def _resumed(cfg: DictConfig, given: Sequence[str]) -> DictConfig:
    """Return the configuration of the earlier run, with what may change taken from the new command line."""
    saved = OmegaConf.load(Path(cfg.resume) / "config.yaml")
    if not isinstance(saved, DictConfig) or "task" not in saved:
        raise UserError(f"resume: {cfg.resume}/config.yaml is not the configuration of a run")
    names = {line.lstrip("+").partition("=")[0].split(".")[0] for line in given}
    for key in CHANGED_ON_RESUME:
        if key in names:
            saved[key] = cfg[key]
    saved["resume"] = cfg.resume
    return saved
