"""PyHelios, the PyPI package pyhelios3d, as a generator: the fruit trees of its WeberPennTree."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Mapping
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # the child process starts by importing this file
    from generators.external.generator import External
    from treefit.plant import Value

PACKAGE = "pyhelios3d"
INSTALL = 'pip install "treefit[pyhelios]"'
LIBRARIES = ("libGL.so.1", "libEGL.so.1", "libX11.so.6", "libXext.so.6", "libSM.so.6", "libICE.so.6")
"""Of the system, which the package does not load without on Linux, though it draws nothing here."""

_HOME = Path(__file__).parent
_RULES = "1"  # changes when the same tree of the package becomes another plant


def pyhelios(
    *,
    timeout: float = 10.0,
    memory: float = 4.0,
    max_vertices: int = 200_000,
    fixed: Mapping[str, Value] | None = None,
) -> External:
    """Return the generator; ValueError with the command that installs it when the package is not there."""
    if not installed():
        raise ValueError(f"pyhelios: the package {PACKAGE} is not installed; install it by: {INSTALL}")
    lacking = lacking_libraries()
    if lacking:
        raise ValueError(
            f"pyhelios: needs {', '.join(lacking)} of the system; on Debian or Ubuntu: "
            "apt-get install libgl1 libegl1 libsm6 libxext6"
        )
    from generators.external.generator import External

    return External(
        name="pyhelios",
        version=f"{version(PACKAGE)}-{_RULES}",
        callable="generators.external.pyhelios.program.grow",
        space=_HOME / "space.yaml",
        presets=_HOME / "presets",
        size_parameter="Scale",
        timeout=timeout,
        memory=memory,
        max_vertices=max_vertices,
        fixed=dict(fixed or {}),
    )


def installed() -> bool:
    """Whether the package is there; it is not imported: only the child process may crash with it."""
    return find_spec("pyhelios") is not None


def lacking_libraries() -> list[str]:
    """Libraries of the system that the package needs and that are not there."""
    return [name for name in LIBRARIES if sys.platform == "linux" and not _loads(name)]


def _loads(name: str) -> bool:
    try:
        ctypes.CDLL(name)
    except OSError:
        return False
    return True
