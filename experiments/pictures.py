"""Where a file that the user names is: from where the user stands, then among the example pictures."""

from __future__ import annotations

import os
from difflib import get_close_matches
from pathlib import Path

from experiments.errors import UserError

EXAMPLES = Path(__file__).parent / "images"


def examples() -> list[str]:
    """Names of the example pictures."""
    files = EXAMPLES.iterdir() if EXAMPLES.is_dir() else ()
    return sorted(file.name for file in files if file.suffix != ".md")


def is_file(name: str) -> bool:
    """Whether `name` is a file, of the user's or among the examples."""
    try:
        return _from_here(name).is_file() or (EXAMPLES / name).is_file()
    except (OSError, ValueError):  # longer than the system allows, or with a zero byte
        return False


def is_there(name: str) -> bool:
    """Whether `name` is a file or a folder of the user's."""
    try:
        return bool(name) and _from_here(name).exists()
    except (OSError, ValueError):
        return False


def absolute(name: str) -> str:
    """Absolute path of a file or folder of the user's; any other name as it is."""
    return str(_from_here(name).resolve()) if is_there(name) else name


def find_file(name: str, place: str) -> Path:
    """Absolute path of the file `name` of the setting `place`; UserError with a proposal when missing."""
    if not is_file(name):
        raise UserError(f"{place}: no such file: {' '.join(name.split())}{_proposal(name, place)}")
    path = _from_here(name)
    return path.resolve() if path.is_file() else (EXAMPLES / name).resolve()


def _from_here(name: str) -> Path:
    """Path of `name` from where the user stands; ~ is the user's home, unless that is not known."""
    return Path(os.path.expanduser(name))  # noqa: PTH111  Path.expanduser fails for a file named ~x.png


def _proposal(name: str, place: str) -> str:
    path = _from_here(name)
    try:
        beside = [str(path.parent / file.name) for file in path.parent.iterdir() if file.is_file()]
    except (OSError, ValueError):
        beside = []
    close = get_close_matches(str(path), beside, n=1) or get_close_matches(path.name, examples(), n=1)
    hint = f"; did you mean {close[0]!r}?" if close else ""
    return f"{hint} (examples: {', '.join(examples())})" if place == "image" else hint
