"""The command line as the user typed it becomes one that Hydra can read: names of files are quoted."""

from __future__ import annotations

import glob
import os
import re
from collections.abc import Callable, Sequence
from pathlib import Path

from experiments.errors import UserError
from experiments.pictures import is_file, is_there

FILE_KEYS = ("image", "preset", "mask.path", "mask.hint", "adapt.example")
FOLDER_KEYS = ("resume", "hydra.run.dir", "hydra.sweep.dir", "tracking.uri", "memory.folder")
START_KEY = "start"
PATTERN_KEYS = ("similarities.masks", "compare.masks", "masks.pictures", "masks.references")
OPEN_KEYS = ("values", "generator.fixed", "compare.variants")
"""Tables that may be given any name; Hydra wants a plus for one that is not in the configuration yet."""

KEPT_ON_RESUME = ("resume", "debug", "live", "tracking", "evaluator", "stop", "hydra")
"""Settings that a resumed run may be given: none of them changes what the search would have found."""

_SETTING = re.compile(r"(?P<key>\+{0,2}[\w./@]+)=(?P<value>.*)", re.DOTALL)
_FUNCTION = re.compile(r"(choice|sort|shuffle|glob|str)\(.*\)")


def prepare(arguments: Sequence[str]) -> list[str]:
    """`arguments` for Hydra: names of files quoted, patterns like folder/*.jpg replaced by their files."""
    sweep = is_sweep(arguments)
    prepared = [_prepare_one(argument, sweep) for argument in arguments]
    folders = [_unquoted(argument.partition("=")[2]) for argument in arguments if _key(argument) == "resume"]
    return _resume(prepared, folders[-1]) if folders and folders[-1] not in ("", "null") else prepared


def is_sweep(arguments: Sequence[str]) -> bool:
    """Whether the command line asks for several runs."""
    return any(argument in ("-m", "--multirun", "hydra.mode=MULTIRUN") for argument in arguments)


def quote(text: str) -> str:
    """`text` as a quoted value of Hydra's grammar that means just these characters."""
    escaped = re.sub(r"(\\*)'", lambda match: match[1] * 2 + r"\'", text).replace("${", r"\${")
    trailing = escaped[len(escaped.rstrip("\\")) :]
    return f"'{escaped}{trailing}'"


def split_names(value: str, exists: Callable[[str], bool]) -> list[str]:
    """Names in a list "a.png,b.png"; a comma within the name of a file that exists does not part it."""
    parts = value.split(",")
    names = []
    while parts:
        longest = next((n for n in range(len(parts), 1, -1) if exists(",".join(parts[:n]))), 1)
        names.append(",".join(parts[:longest]))
        parts = parts[longest:]
    return names


def _key(argument: str) -> str:
    match = _SETTING.fullmatch(argument)
    return match["key"].lstrip("+") if match else ""


def _prepare_one(argument: str, sweep: bool) -> str:
    match, key = _SETTING.fullmatch(argument), _key(argument)
    if key.startswith(tuple(f"{table}." for table in OPEN_KEYS)) or key in OPEN_KEYS:
        return f"++{argument.lstrip('+')}"
    if match and key == START_KEY and is_there(match["value"]):
        return f"{match['key']}={quote(match['value'])}"
    if not match or key not in FILE_KEYS + FOLDER_KEYS + PATTERN_KEYS:
        return argument
    value = match["value"]
    if key in FOLDER_KEYS + PATTERN_KEYS:
        plain = "${" in value or _is_settled(value)
        return argument if plain else f"{match['key']}={quote(value)}"
    if not is_file(value) and _is_settled(value):
        return argument
    names = [name for part in split_names(value, is_file) for name in _expand(part, key)]
    if len(names) > 1 and not sweep:
        raise UserError(f"{key}: {value!r} means {len(names)} files; add -m to run once for each of them")
    return f"{match['key']}={','.join(quote(name) for name in names)}"


def _is_settled(value: str) -> bool:
    """Whether `value` is empty, null, already quoted or a function of Hydra's grammar."""
    return value in ("", "null") or _unquoted(value) != value or bool(_FUNCTION.fullmatch(value))


def _expand(name: str, key: str) -> list[str]:
    """Files that the pattern `name` matches, in order; `name` itself when it is no pattern."""
    if is_file(name) or not glob.has_magic(name):
        return [name]
    pattern = os.path.expanduser(name)  # noqa: PTH111  as in pictures.py; and Path.glob takes no absolute pattern
    files = sorted(file for file in glob.glob(pattern, recursive=True) if Path(file).is_file())  # noqa: PTH207
    if not files and ("*" in name or "?" in name):
        raise UserError(f"{key}: no file matches the pattern {name!r}")
    return files or [name]


def _unquoted(value: str) -> str:
    return value[1:-1] if len(value) > 1 and value[0] == value[-1] and value[0] in "'\"" else value


def _resume(arguments: list[str], name: str) -> list[str]:
    """`arguments` that go on in the folder `name` of an earlier run."""
    if is_sweep(arguments):
        raise UserError("resume: goes on with one run; leave out -m")
    given = {_key(argument): argument for argument in arguments if _key(argument)}
    folder = Path(os.path.expanduser(name)).resolve()  # noqa: PTH111
    for key, argument in given.items():
        if re.split(r"[./]", key)[0] not in KEPT_ON_RESUME or key == "hydra.run.dir":
            raise UserError(
                f"resume: the run keeps its settings, leave out {argument!r} "
                f"(may be given: {', '.join(KEPT_ON_RESUME[1:])})"
            )
    if not (folder / "config.yaml").is_file():
        raise UserError(f"resume: {folder} is not the folder of a run: it has no config.yaml")
    rest = [argument for argument in arguments if _key(argument) != "resume"]
    return [*rest, f"resume={quote(str(folder))}", f"hydra.run.dir={quote(str(folder))}"]
