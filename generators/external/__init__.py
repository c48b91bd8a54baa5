"""External: any program, any Python function, any mesh of a tree as a generator; the guide is README.md beside this.

What is named here is imported when it is asked for: the processes of the adapters import this too, and need none of it.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from generators.external.generator import External, ExternalError
    from generators.external.mesh import Mesh

__all__ = ["External", "ExternalError", "Mesh"]


def __getattr__(name: str) -> object:
    if name not in __all__:
        raise AttributeError(f"module 'generators.external' has no attribute {name!r}")
    home = "mesh" if name == "Mesh" else "generator"
    return getattr(import_module(f"generators.external.{home}"), name)
