"""Fits parameters of procedural plant generators to one picture of a tree.

What is named here is imported when it is asked for: the process of a foreign generator needs `treefit.plant` alone, and
three times as long to start with all the rest.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from treefit.asset import AssetSettings, write_glb
    from treefit.candidates import Candidate
    from treefit.fit import Result, fit
    from treefit.objective import Score
    from treefit.plant import write_preset
    from treefit.plant.characteristics import Characteristics
    from treefit.search import CMAES, RandomSearch, TreeGA
    from treefit.stop import Stop

__all__ = [
    "CMAES",
    "AssetSettings",
    "Candidate",
    "Characteristics",
    "RandomSearch",
    "Result",
    "Score",
    "Stop",
    "TreeGA",
    "fit",
    "write_glb",
    "write_preset",
]

_HOMES = {
    "treefit.asset": ("AssetSettings", "write_glb"), "treefit.candidates": ("Candidate",), "treefit.fit": ("Result",),
    "treefit.objective": ("Score",), "treefit.plant": ("write_preset",), "treefit.stop": ("Stop",),
    "treefit.plant.characteristics": ("Characteristics",), "treefit.search": ("CMAES", "RandomSearch", "TreeGA"),
}  # fmt: skip


def __getattr__(name: str) -> object:
    for home, names in _HOMES.items():
        if name in names:
            return getattr(import_module(home), name)
    raise AttributeError(f"module 'treefit' has no attribute {name!r}")


class _Package(ModuleType):
    """The package, in which `fit` is the function: the module of that name would take its place once it is imported."""

    @property
    def fit(self) -> object:
        """The function."""
        return import_module("treefit.fit").fit

    @fit.setter
    def fit(self, module: ModuleType) -> None:
        """Leave things as they are: what an import sets is the module."""


sys.modules[__name__].__class__ = _Package
