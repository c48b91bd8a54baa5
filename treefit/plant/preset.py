"""Preset: the values and the seed that make one plant, as a small YAML file that `task=grow` takes back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import yaml

from treefit.plant.parameters import Value

KEYS = ("generator", "version", "seed", "values")


@dataclass(frozen=True)
class Preset:
    """One plant of a generator."""

    generator: str
    version: str
    seed: int
    values: Mapping[str, Value]
    look: Mapping[str, str] = field(default_factory=dict)  # of bark and leaves, where the plant has one of its own


def write_preset(
    path: Path | str,
    *,
    generator: str,
    version: str,
    seed: int,
    values: Mapping[str, Value],
    look: Mapping[str, str] | None = None,
    notes: Mapping[str, str | float] | None = None,
) -> None:
    """Write a preset to `path`; `look` is that of bark and leaves, `notes` (a score, say) are not read back."""
    content: dict[str, object] = {
        "generator": str(generator),
        "version": str(version),
        "seed": int(seed),
        "values": {str(name): _plain(value) for name, value in values.items()},
    }
    if look:
        content["look"] = dict(look)
    if notes:
        content["notes"] = {str(name): _plain(note) for name, note in notes.items()}
    text = yaml.safe_dump(content, sort_keys=False, allow_unicode=True, width=1000)
    Path(path).write_text(text, encoding="utf-8")


def read_preset(path: Path | str) -> Preset:
    """Return the preset in the file `path`; ValueError with one line for everything that is wrong with it."""
    content = _load(path)
    if not isinstance(content, dict):
        raise ValueError(f"preset {path}: must have the keys {', '.join(KEYS)}, is no table of keys")
    missing = [key for key in KEYS if key not in content]
    if missing:
        raise ValueError(f"preset {path}: must have the keys {', '.join(KEYS)}, lacks {', '.join(missing)}")
    unknown = [str(key) for key in content if key not in (*KEYS, "look", "notes")]
    if unknown:
        raise ValueError(f"preset {path}: has keys that no preset has: {', '.join(unknown)}")
    generator, version, seed, values = (content[key] for key in KEYS)
    if not isinstance(generator, str) or not generator:
        raise ValueError(f"preset {path}: generator must be a name, got {generator!r}")
    if isinstance(version, bool) or not isinstance(version, str | int | float):
        raise ValueError(f"preset {path}: version must be a text, got {version!r}")
    if isinstance(seed, bool) or not isinstance(seed, int) or seed < 0:
        raise ValueError(f"preset {path}: seed must be a whole number from 0 on, got {seed!r}")
    if not isinstance(values, dict):
        raise ValueError(f"preset {path}: values must be a table of parameter names and values, got {values!r}")
    for name, value in values.items():
        _check_value(path, name, value)
    look = content.get("look") or {}
    if not isinstance(look, dict) or not all(isinstance(word, str) for pair in look.items() for word in pair):
        raise ValueError(f"preset {path}: look must be a table of names and texts, got {look!r}")
    return Preset(generator, str(version), seed, values, look)


def read_presets(folder: Path | str) -> dict[str, Preset]:
    """Return the presets in the files `*.yaml` of `folder` by the names of the files without the ending, sorted."""
    files = sorted(Path(folder).glob("*.yaml"), key=lambda file: file.stem)
    return {file.stem: read_preset(file) for file in files}


def _load(path: Path | str) -> object:
    try:
        content: object = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise ValueError(f"preset {path}: cannot be read: {error.strerror}") from None
    except (UnicodeDecodeError, yaml.YAMLError, RecursionError, ValueError) as error:
        where = getattr(error, "problem_mark", None)
        line = f" (line {where.line + 1})" if where is not None else ""
        raise ValueError(f"preset {path}: is no YAML file{line}") from None
    return content


def _check_value(path: Path | str, name: object, value: object) -> None:
    if not isinstance(name, str):
        raise ValueError(f"preset {path}: parameter names must be texts, got {name!r}")
    if not isinstance(value, str | bool | int | float):
        raise ValueError(f"preset {path}: values.{name} must be a number, a text, true or false, got {value!r}")
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"preset {path}: values.{name} must be a finite number, got {value}")


def _plain(value: Value) -> Value:
    """Return `value` without its numpy type, which YAML would not know."""
    item = getattr(value, "item", None)
    plain: Value = item() if callable(item) else value
    return plain
