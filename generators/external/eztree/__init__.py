"""ez-tree, the npm package @dgreenheck/ez-tree, as a generator: trees of deciduous and evergreen kinds with leaves."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path

from generators.external.generator import External
from treefit.plant import Value

PACKAGE, VERSION = "@dgreenheck/ez-tree", "1.1.0"
INSTALL = "npm install --prefix generators/external/eztree"

_HOME = Path(__file__).parent
_PROGRAM = _HOME / "program.mjs"


def eztree(
    *,
    node: str = "node",
    timeout: float = 10.0,
    memory: float = 4.0,
    max_vertices: int = 200_000,
    fixed: Mapping[str, Value] | None = None,
) -> External:
    """Return the generator; ValueError with the command that installs it when Node.js or the package is not there."""
    if shutil.which(node) is None:
        raise ValueError(
            f"eztree: needs Node.js 18 or newer, there is no program {node!r}; install it, then: {INSTALL}"
        )
    if not installed():
        raise ValueError(f"eztree: the npm package {PACKAGE} is not installed; install it by: {INSTALL}")
    return External(
        name="eztree",
        version=VERSION,
        command=[node, str(_PROGRAM)],
        space=_HOME / "space.yaml",
        presets=_HOME / "presets",
        size_parameter="metres",
        timeout=timeout,
        memory=memory,
        max_vertices=max_vertices,
        fixed=dict(fixed or {}),
    )


def installed() -> bool:
    """Whether Node.js would find the package: in node_modules of this folder or one above."""
    return any((folder / "node_modules" / PACKAGE).is_dir() for folder in (_HOME, *_HOME.parents))
