"""One shot: a program that is started anew for every tree, its values written into the command."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from generators.external.limits import START, Limits
from generators.external.process import Process
from treefit.plant import Values

_PLACE = re.compile(r"\{([\w.-]+)\}")


def is_template(command: Sequence[str]) -> bool:
    """Whether `command` names the file to be written, as {out}: then it is run once a tree."""
    return any("{out}" in part for part in command)


def filled(command: Sequence[str], values: Values, seed: int, out: Path, file: Path) -> list[str]:
    """Return `command` with what it has in braces: out, seed, values (a JSON file) and names of parameters."""
    known = {"out": str(out), "seed": str(seed), "values": str(file), **{name: _text(values[name]) for name in values}}
    return [_PLACE.sub(lambda place: known.get(place[1], place[0]), part) for part in command]


def grow_once(
    command: Sequence[str], values: Values, seed: int, folder: Path, limits: Limits, environment: Mapping[str, str]
) -> Path:
    """Run the template `command` in the empty `folder`; return the path, without its suffix, of what it wrote."""
    folder.mkdir(parents=True)
    out, file = folder / "tree", folder / "values.json"
    file.write_text(json.dumps(dict(values)), encoding="utf-8")
    process = Process(filled(command, values, seed, out, file), folder, limits, environment, listens=False)
    try:
        while process.wait(limits.timeout + START) is not None:
            pass  # it prints something that looks like an answer
    finally:
        process.end()
    return out


def _text(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
