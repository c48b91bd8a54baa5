"""A group of the configuration becomes the object that it describes, by Hydra's instantiate."""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from typing import Any, cast

from hydra.errors import InstantiationException
from hydra.utils import instantiate
from omegaconf import DictConfig, OmegaConf
from pydantic import ValidationError

from experiments.errors import UserError, describe_validation, did_you_mean, one_line
from experiments.targets import check_targets, located, opted_in


def build(cfg_node: DictConfig, place: str, modules: Sequence[str] | None = None) -> object:
    """Object that `cfg_node` describes by `_target_`; `place` is its name in the configuration, for messages.

    `modules` are those of the user's own that it may come from; None: those that the whole configuration names.

    Raises UserError with one line for a setting of a wrong name, type or range, and for a `_target_` outside
    this project: a configuration file must not be able to run any code of the machine.
    """
    if not OmegaConf.is_config(cfg_node) or "_target_" not in cfg_node:
        raise UserError(f"{place}: needs a group with a _target_, got {cfg_node!r}")
    settings = OmegaConf.to_container(cfg_node, resolve=True)
    modules = opted_in(cfg_node) if modules is None else modules
    check_targets(settings, place, modules)
    _check_names(settings, place, modules)
    try:
        return instantiate(cfg_node, _convert_="all")
    except InstantiationException as error:
        raise UserError(_explain(error, place)) from error


def _check_names(settings: object, place: str, modules: Sequence[str]) -> None:
    """Raise UserError for a setting that its target does not take: pydantic would not say which it takes."""
    if not isinstance(settings, Mapping):
        return
    taken = _settings_of(str(settings["_target_"]), place, modules) if "_target_" in settings else ()
    for name, value in settings.items():
        if not str(name).startswith("_") and taken and name not in taken:
            raise UserError(f"{place}.{name}: no such setting{did_you_mean(str(name), taken)}")
        _check_names(value, f"{place}.{name}", modules)


def _settings_of(target: str, place: str, modules: Sequence[str]) -> tuple[str, ...]:
    """Names that `target` takes, () when it takes any."""
    try:
        parameters = inspect.signature(cast(Any, located(target, place, modules))).parameters.values()
    except (TypeError, ValueError) as error:
        raise UserError(f"{place}: cannot use _target_ {target!r}: {one_line(error)}") from error
    if any(parameter.kind is parameter.VAR_KEYWORD for parameter in parameters):
        return ()
    return tuple(parameter.name for parameter in parameters)


def _explain(error: InstantiationException, place: str) -> str:
    cause: BaseException = error
    while cause.__cause__ is not None:
        cause = cause.__cause__
        if isinstance(cause, ValidationError):
            return describe_validation(cause, _within(error, place))
    if isinstance(cause, InstantiationException):
        return f"{place}: {one_line(cause).partition(' full_key:')[0]}"
    message = one_line(cause)
    return message if message.startswith(place) else f"{place}: {message}"


def _within(error: InstantiationException, place: str) -> str:
    """`place`, or the place in it that Hydra was building: mask.network."""
    _, _, key = str(error).partition("full_key: ")
    inner = key.split()[0] if key.split() else ""
    if not inner or inner == place or inner.startswith(f"{place}."):
        return inner or place
    return f"{place}.{inner}"
