"""Markdown of the pages that studies write: tables, the command that makes a page, and with what."""

from __future__ import annotations

import platform
import re
from collections.abc import Iterable, Sequence
from importlib.metadata import version
from pathlib import Path

LEFT, RIGHT = ":---", "---:"


def table(head: Sequence[str], rows: Iterable[Sequence[str]], sides: Sequence[str] | None = None) -> list[str]:
    """Lines of a table; without `sides` the first column is on the left, the others are on the right."""
    sides = sides or [LEFT, *([RIGHT] * (len(head) - 1))]
    return ["| " + " | ".join(line) + " |" for line in [head, sides, *rows]]


def command(given: Iterable[str]) -> str:
    """Return the command of the `given` settings as it is typed, without the folders of the machine."""
    return f"python run.py {' '.join(_plain(one) for one in given)}"


def versions() -> str:
    """Versions of what may change a result."""
    packages = ", ".join(f"{name} {version(name)}" for name in ("treefit", "numba", "numpy"))
    return f"Python {platform.python_version()}, {packages}"


def _plain(setting: str) -> str:
    name, _, value = setting.partition("=")
    value = value.strip("'\"")
    if name.endswith((".masks", ".pictures", ".references")):
        value = "/".join(Path(value).parts[-2:])
    return f"{name}={value}" if re.fullmatch(r"[\w./:+-]*", value) else f"'{name}={value}'"
