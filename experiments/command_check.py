"""Checks a command line before Hydra runs it, so that whatever is wrong with it is said in one line."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import cast

from hydra import compose, initialize_config_dir
from hydra._internal.core_plugins.basic_sweeper import BasicSweeper
from hydra.core.config_loader import ConfigLoader
from hydra.core.global_hydra import GlobalHydra
from hydra.core.object_type import ObjectType
from hydra.core.override_parser.overrides_parser import OverridesParser
from hydra.core.override_parser.types import Override, OverrideType
from hydra.errors import HydraException
from omegaconf import DictConfig, OmegaConf
from omegaconf.errors import OmegaConfBaseException

from experiments import names  # noqa: F401  the configuration needs its resolver
from experiments.build import build
from experiments.errors import UserError, blame, did_you_mean, one_line
from experiments.extractor import build_extractor
from experiments.preset import find_preset
from experiments.run_folder import settle
from experiments.settings import TASKS, Settings, Strip, read_settings
from experiments.sheet_values import choose
from experiments.start import find_start
from experiments.strip_growth import shown_parameter
from treefit.plant import Generator

BUILDERS: dict[str, Callable[[DictConfig, str], object]] = {"mask": build_extractor}
"""What builds a group, where it is not `build`."""

CONFIG_FOLDER = Path(__file__).parents[1] / "conf"


def check(settings: Sequence[str], sweep: bool) -> None:
    """Raise UserError with one line when the `settings` ("name=value") are wrong, for any run of a sweep."""
    for run, cfg in _composed(settings, sweep):
        _check_values(run, cfg)


def check_names(settings: Sequence[str], sweep: bool) -> None:
    """Raise UserError with one line when `settings` name what is not there; whether it makes sense is left open."""
    for _ in _composed(settings, sweep):
        pass


def _composed(settings: Sequence[str], sweep: bool) -> Iterator[tuple[list[Override], DictConfig]]:
    """Yield the settings and the configuration of each run."""
    with initialize_config_dir(str(CONFIG_FOLDER), version_base="1.3"):
        loader = GlobalHydra.instance().config_loader()
        parser = OverridesParser.create()
        for run in _runs(_parse(settings, loader), sweep):
            overrides = parser.parse_overrides(run)
            for override in overrides:
                _check_option(override, loader)
            yield overrides, _compose(overrides, loader)


def _check_values(overrides: list[Override], cfg: DictConfig) -> None:
    settled = settle(cfg, [override.input_line or "" for override in overrides])
    settings = read_settings(settled)
    task = settings.task
    touched = {override.key_or_group.partition(".")[0] for override in overrides}
    for group in sorted(settled, key=lambda group: group not in touched):  # what the user set is told first
        node = settled[group]
        if OmegaConf.is_dict(node) and "_target_" in node and (group in TASKS[task] or group in touched):
            BUILDERS.get(str(group), build)(node, str(group))
    _check_of_generator(settled, settings)


def _check_of_generator(cfg: DictConfig, settings: Settings) -> None:
    """Raise UserError for what only the generator knows: its presets, the names and values of its parameters."""
    chosen = settings.sheet.names if settings.task == "sheet" else None
    strip = settings.strip if settings.task == "grow" else Strip()
    begins = settings.start if settings.task == "fit" and not settings.resume else ()
    if settings.preset is None and chosen is None and not settings.values and strip == Strip() and not begins:
        return
    generator = cast(Generator, build(cfg.generator, "generator"))
    if settings.preset is not None:
        find_preset(settings.preset, generator)
    find_start(begins, generator)
    choose(generator.space, chosen)
    shown_parameter(generator, strip)
    with blame("values"):
        generator.space.complete(settings.values)


def _parse(settings: Sequence[str], loader: ConfigLoader) -> list[Override]:
    parser = OverridesParser.create(config_loader=loader)
    parsed = []
    for setting in settings:
        name = setting.lstrip("+").partition("=")[0]
        if not name or ("=" not in setting and not setting.startswith("~")):
            raise UserError(f"{setting!r}: write name=value, e.g. image=pine.png (python run.py --help)")
        try:
            parsed.append(parser.parse_override(setting))
        except HydraException as error:
            name, _, value = setting.partition("=")
            reason = one_line(error).partition(" See https")[0]
            raise UserError(
                f"{name}: cannot read {value!r}: {reason}; text with special characters needs two kinds of quotes: "
                f"\"{name}='...'\""
            ) from error
    return parsed


def _runs(overrides: list[Override], sweep: bool) -> list[list[str]]:
    """Return the settings of each run, "name=value"."""
    several = [override for override in overrides if override.is_sweep_override()]
    if several and not sweep:
        raise UserError(f"{several[0].key_or_group}: {several[0].get_value_string()!r} means several runs; add -m")
    hydras = [override.input_line or "" for override in overrides if override.is_hydra_override()]
    tasks = [override for override in overrides if not override.is_hydra_override()]
    try:
        batches = BasicSweeper.split_arguments(tasks, max_batch_size=None)
    except HydraException as error:
        raise UserError(one_line(error)) from error
    return [hydras + run for batch in batches for run in batch]


def _compose(overrides: list[Override], loader: ConfigLoader) -> DictConfig:
    lines = [override.input_line or "" for override in overrides]
    try:
        return compose("config", overrides=lines)
    except (HydraException, OmegaConfBaseException) as error:
        groups = [override.input_line or "" for override in overrides if _options(override, loader)]
        if len(groups) < len(lines):
            base = compose("config", overrides=groups, return_hydra_config=True)
            for override in overrides:
                if override.input_line not in groups:
                    _check_key(override, base, loader)
        raise UserError(_reason(error)) from error


def _options(override: Override, loader: ConfigLoader) -> list[str]:
    """Options of the group that `override` chooses from, [] when it names no group."""
    if "." in override.key_or_group:
        return []
    return loader.get_group_options(override.key_or_group, ObjectType.CONFIG)


def _check_option(override: Override, loader: ConfigLoader) -> None:
    options, value = _options(override, loader), override.value()
    if not options or override.is_delete() or value is None:
        return
    for name in value if isinstance(value, list) else [value]:
        if str(name) not in options:
            raise UserError(f"{override.key_or_group}: no option {str(name)!r}{did_you_mean(str(name), options)}")


def _check_key(override: Override, cfg: DictConfig, loader: ConfigLoader) -> None:
    """Raise UserError when `override` changes a setting that is not in `cfg`."""
    if override.type != OverrideType.CHANGE:
        return
    node = OmegaConf.to_container(cfg, resolve=False)
    place = ""
    for part in override.key_or_group.split("."):
        if not isinstance(node, dict):
            raise UserError(f"{place}: has no parts, so there is no {override.key_or_group!r}")
        if part not in node:
            known = _shown(node) if place else {*_shown(node), *loader.list_groups("")} - {"hydra"}
            raise UserError(f"{override.key_or_group}: no such setting{did_you_mean(part, known)}")
        node, place = node[part], f"{place}.{part}".strip(".")


def _shown(node: Iterable[object]) -> set[str]:
    return {str(name) for name in node if not str(name).startswith("_")}


def _reason(error: BaseException) -> str:
    """One line that says why the configuration cannot be put together; the deepest cause knows it best."""
    while error.__cause__ is not None:
        error = error.__cause__
    return one_line(error).partition(" full_key:")[0]
