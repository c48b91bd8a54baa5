"""Targets: which objects a `_target_` of the configuration may name; a configuration must not run any code there is."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from importlib import import_module
from pathlib import Path
from typing import Annotated

from omegaconf import DictConfig, ListConfig, OmegaConf
from pydantic import BeforeValidator, Field

from experiments.errors import UserError, one_line
from experiments.start_settings import listed

ALLOWED = ("treefit", "generators")
"""Packages whose objects a configuration may name."""

NAME = r"^[^\W\d]\w*(\.[^\W\d]\w*)*$"
"""Dotted name of a module."""

Modules = Annotated[tuple[Annotated[str, Field(pattern=NAME)], ...], BeforeValidator(listed)]
"""Modules of the user's own that a `_target_` may name too."""


def opted_in(cfg_node: DictConfig | ListConfig) -> tuple[str, ...]:
    """Return the modules that the configuration around the group `cfg_node` names in its `modules`."""
    root = cfg_node._get_root()
    if root is cfg_node or not isinstance(root, DictConfig):
        return ()
    named = root.get("modules")
    found = listed(OmegaConf.to_container(named) if OmegaConf.is_config(named) else named)
    for name in found:
        if not isinstance(name, str) or not re.fullmatch(NAME, name):
            raise UserError(f"modules: must be names of Python modules, got {name!r}")
    return tuple(str(name) for name in found)


def check_targets(settings: object, place: str, modules: Sequence[str]) -> None:
    """Raise UserError for a `_target_` anywhere in `settings` that is neither of this project nor of `modules`."""
    for target in _targets(settings):
        located(target, place, modules)


def located(target: str, place: str, modules: Sequence[str]) -> object:
    """Return what `target` names; UserError when it may not be named, cannot be imported, or comes from elsewhere."""
    allowed = (*ALLOWED, *modules)
    if not _within(target, allowed):
        raise UserError(f"{place}: _target_ must be of {', '.join(allowed)}, got {target!r}; {_advice(target)}")
    if modules:
        _look_where_the_user_stands()
    module, _, name = target.rpartition(".")
    try:
        found: object = getattr(import_module(module), name)
        walked = reduce(getattr, target.split(".")[1:], import_module(target.partition(".")[0]))
    except (Exception, SystemExit) as error:  # a module may do anything while it is imported
        raise UserError(f"{place}: cannot use _target_ {target!r}: {one_line(error)}") from error
    home = getattr(found, "__module__", None)
    if found is not walked or not isinstance(home, str) or not _within(f"{home}.", allowed):
        raise UserError(f"{place}: _target_ {target!r} is not of {', '.join(allowed)}, but of {home}; {_advice(home)}")
    return found


def _targets(settings: object) -> Iterator[str]:
    if isinstance(settings, Mapping):
        if "_target_" in settings:
            yield str(settings["_target_"])
        for value in settings.values():
            yield from _targets(value)
    elif isinstance(settings, list):
        for value in settings:
            yield from _targets(value)


def _within(name: str, packages: Sequence[str]) -> bool:
    return name.startswith(tuple(f"{package}." for package in packages))


def _advice(name: str | None) -> str:
    """Words on how a module of one's own is let in."""
    module = str(name).rpartition(".")[0] or str(name)
    own = "my_trees" if module.partition(".")[0] in (*sys.stdlib_module_names, "None") else module
    return f"a module of yours is let in by modules=[{own}]"


def _look_where_the_user_stands() -> None:
    """Let modules be found in the current folder too, after all others: run.py is started from its own."""
    here = str(Path.cwd())
    if here not in sys.path:
        sys.path.append(here)
