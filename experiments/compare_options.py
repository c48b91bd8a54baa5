"""Optimisers and generators of the task compare, by the names of their files in conf."""

from __future__ import annotations

from collections.abc import Mapping
from typing import cast

from omegaconf import DictConfig, OmegaConf

from experiments.build import build
from experiments.command_check import CONFIG_FOLDER
from experiments.compare_settings import Compare, Setting
from experiments.errors import UserError, did_you_mean
from treefit.plant import Generator
from treefit.search import Strategy


def option(group: str, name: str, place: str) -> DictConfig:
    """Settings in conf/<group>/<name>.yaml; UserError that begins with `place` when there is no such file."""
    known = [file.stem for file in (CONFIG_FOLDER / group).glob("*.yaml")]
    if name not in known:
        raise UserError(f"{place}: no {group} {name!r}{did_you_mean(name, known)}")
    return cast(DictConfig, OmegaConf.load(CONFIG_FOLDER / group / f"{name}.yaml"))


def strategies(wanted: Compare) -> dict[str, Strategy]:
    """Every optimiser by name, with the evaluations of the comparison."""
    places = {"compare.optimizers": wanted.optimizers, "compare.baselines": wanted.baselines}
    for name in wanted.reference:  # it need not be compared, but must be one
        _strategy(name, wanted, "compare.reference")
    return {name: _strategy(name, wanted, place) for place, names in places.items() for name in names}


def generators(wanted: Compare) -> dict[str, tuple[Generator, str]]:
    """Every generator by name, with its settings in words."""
    found = {}
    for name in wanted.generators:
        node = option("generator", name, "compare.generators")
        found[name] = cast(Generator, build(node, f"compare.generators: {name}")), str(OmegaConf.to_container(node))
    return found


def _strategy(name: str, wanted: Compare, place: str) -> Strategy:
    variant = wanted.variants.get(name)
    base, place = _base(name, variant), place if variant is None else f"compare.variants.{name}"
    node = option("optimizer", base, place)
    more = {key: value for key, value in (variant or {}).items() if key != "base"}
    node = cast(DictConfig, OmegaConf.merge(node, more, {"evaluations": wanted.evaluations}))
    return cast(Strategy, build(node, place if variant else f"{place}: {name}"))


def _base(name: str, variant: Mapping[str, Setting] | None) -> str:
    if variant is None:
        return name
    if "base" not in variant:
        raise UserError(f"compare.variants.{name}: needs a base, the name of an optimizer that it is a variant of")
    return str(variant["base"])
