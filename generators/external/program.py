"""Program: what a foreign generator's settings name becomes a command, with its home, its name and its version."""

from __future__ import annotations

import hashlib
import importlib.machinery
import os
import shutil
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.metadata import entry_points
from pathlib import Path

GROUP = "treefit.generators"
"""Entry points of packages that have a generator: name = "module:function"."""

_PROJECT = Path(__file__).parents[2]
_HOST = Path(__file__).with_name("host.py")
_SCRIPTS = (".py", ".js", ".mjs", ".cjs", ".jar", ".rb", ".lua", ".jl", ".R", ".sh")


@dataclass(frozen=True)
class Program:
    """A command with what is added to its environment, the folder that it lives in, its name and its version.

    The version is a digest of the files that it is known to be made of, "1" when there are none.
    """

    command: tuple[str, ...]
    home: Path
    name: str
    version: str
    environment: Mapping[str, str] = field(default_factory=dict)


def program_of(command: Sequence[str] | None, function: str | None, up: str) -> Program:
    """Program of a `command`, or that serves the Python `function` ("package.module.name" or an entry point).

    That server turns trees whose axis `up`, y or z, points upwards.
    ValueError with one line when neither or both are given, or when there is no such program or module.
    """
    if (command is None) == (function is None):
        raise ValueError("give either command, e.g. generator.command=[python3,my_tree.py], or callable=my_tree.grow")
    return _of_command(command) if command is not None else _of_function(str(function), up)


def _of_command(command: Sequence[str]) -> Program:
    program = shutil.which(os.path.expanduser(command[0]))  # noqa: PTH111  a program is no path yet
    if program is None:
        raise ValueError(f"command: there is no program {command[0]!r} on the PATH")
    files = [Path(part) for part in command[1:] if Path(part).suffix in _SCRIPTS]
    missing = [str(file) for file in files if not file.is_file()]
    if missing:
        raise ValueError(f"command: there is no file {missing[0]!r} in {Path.cwd()}")
    whole = [str(file.absolute()) for file in files]
    parts = [str(Path(part).absolute()) if Path(part) in files else part for part in command[1:]]
    home = Path(whole[0]).parent if whole else Path.cwd()
    name = Path(whole[0] if whole else program).stem
    return Program((program, *parts), home, name, _version(map(Path, whole)))


def _of_function(name: str, up: str) -> Program:
    points = {point.name: point.value for point in entry_points(group=GROUP)}
    target = points.get(name, name).replace(":", ".")
    module, _, function = target.rpartition(".")
    if not module or not all(part.isidentifier() for part in target.split(".")):
        known = f" (there is: {', '.join(sorted(points))})" if points else ""
        raise ValueError(f"callable: must be package.module.function or an entry point of {GROUP}{known}, got {name!r}")
    file = _module_file(module)
    if file is None:
        raise ValueError(f"callable: there is no module {module!r}, neither installed nor in {Path.cwd()}")
    path = os.pathsep.join([str(_PROJECT), *filter(None, [os.environ.get("PYTHONPATH")])])
    command = (sys.executable, str(_HOST), f"{module}:{function}", up)
    return Program(command, file.parent, name.rpartition(".")[0] or name, _version([file]), {"PYTHONPATH": path})


def _module_file(module: str) -> Path | None:
    """File of `module`, found without running any of it; None when there is none."""
    path, file = [str(Path.cwd()), *sys.path], None
    parts = module.split(".")
    for i in range(len(parts)):
        spec = importlib.machinery.PathFinder.find_spec(".".join(parts[: i + 1]), path)
        if spec is None:
            return None
        path, file = list(spec.submodule_search_locations or []), spec.origin
    return None if file is None else Path(file)


def _version(files: Iterable[Path]) -> str:
    content = b"".join(file.read_bytes() for file in files)
    return hashlib.sha256(content).hexdigest()[:8] if content else "1"
