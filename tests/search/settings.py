"""What the files of conf/optimizer say."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from treefit import search

CONF = Path(__file__).parents[2] / "conf" / "optimizer"
OPTIMIZERS = sorted(path.stem for path in CONF.glob("*.yaml"))


def settings(name: str) -> dict[str, Any]:
    """Settings in the file of an optimizer."""
    return {key: value for key, value in _read(name).items() if key != "_target_"}


def kind(name: str) -> Any:
    """Class that the file of an optimizer is for."""
    return getattr(search, str(_read(name)["_target_"]).removeprefix("treefit.search."))


def cma_es(**changes: Any) -> search.CMAES:
    """CMA-ES as its own file has it, with other settings."""
    return search.CMAES(**{**settings("cma_es"), **changes})


def _read(name: str) -> dict[str, Any]:
    return dict(yaml.safe_load((CONF / f"{name}.yaml").read_text(encoding="utf-8")))
