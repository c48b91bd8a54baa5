"""modular-tree, the PyPI package of that name, as a generator: trunk, branches and twigs, with leaves added here."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # the child process starts by importing this file
    from generators.external.generator import External
    from treefit.plant import Value

PACKAGE = "modular-tree"
INSTALL = 'pip install "treefit[modular-tree]"'

_HOME = Path(__file__).parent
_RULES = "1"  # changes when the same tree of the package becomes another plant


def modular_tree(
    *,
    timeout: float = 10.0,
    memory: float = 4.0,
    max_vertices: int = 200_000,
    fixed: Mapping[str, Value] | None = None,
) -> External:
    """Return the generator; ValueError with the command that installs it when the package is not there."""
    if not installed():
        raise ValueError(f"modular_tree: the package {PACKAGE} is not installed; install it by: {INSTALL}")
    from generators.external.generator import External

    return External(
        name="modular_tree",
        version=f"{version(PACKAGE)}-{_RULES}",
        callable="generators.external.modular_tree.program.grow",
        space=_HOME / "space.yaml",
        presets=_HOME / "presets",
        size_parameter="scale",
        timeout=timeout,
        memory=memory,
        max_vertices=max_vertices,
        fixed=dict(fixed or {}),
    )


def installed() -> bool:
    """Whether the package is there; it is not imported: only the child process may crash with it."""
    return find_spec("m_tree") is not None
