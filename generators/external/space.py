"""Space: the file space.yaml, in which the author of a generator says what its parameters are."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import cast

import yaml

from treefit.plant import Parameter, ParameterSpace, Value

KEYS = ("name", "type", "low", "high", "log", "default", "unit", "doc", "choices")
TYPES = ("float", "int", "bool", "choice")


def read_space(path: Path | str) -> ParameterSpace:
    """Return the space in the file `path`: a list `parameters`, a mapping `fixed` of names to values.

    A number's default is the middle of its range when none is given, on a log scale the geometric one. Names in
    `fixed` may be of `parameters` or further ones. ValueError with one line for everything that is wrong.
    """
    content = _load(path)
    try:
        return space_of(content)
    except ValueError as error:
        raise ValueError(f"space {path}: {error}") from None


def space_of(content: object) -> ParameterSpace:
    """Return the space of what a space file holds; ValueError with one line for what is wrong with it."""
    if not isinstance(content, Mapping) or not isinstance(content.get("parameters"), list):
        raise ValueError("needs a list `parameters` and may have a mapping `fixed`")
    unknown = [str(key) for key in content if key not in ("parameters", "fixed")]
    if unknown:
        raise ValueError(f"has {', '.join(unknown)}: only parameters and fixed are known")
    parameters = [_parameter(entry, i) for i, entry in enumerate(content["parameters"])]
    fixed = content.get("fixed") or {}
    if not isinstance(fixed, Mapping):
        raise ValueError(f"fixed must be a mapping of names to values, got {fixed!r}")
    named = {parameter.name for parameter in parameters}
    fixed = {str(name): _scalar(value, f"fixed.{name}") for name, value in fixed.items()}
    parameters += [_constant(name, value) for name, value in fixed.items() if name not in named]
    space = ParameterSpace(tuple(parameters), fixed)
    if not space.free:
        raise ValueError("all parameters are fixed: there is nothing to search")
    return space


def _load(path: Path | str) -> object:
    try:
        return cast(object, yaml.safe_load(Path(path).read_text(encoding="utf-8")))
    except OSError as error:
        raise ValueError(f"space {path}: cannot be read: {error.strerror}") from None
    except (UnicodeDecodeError, yaml.YAMLError, RecursionError) as error:
        where = getattr(error, "problem_mark", None)
        line = f" (line {where.line + 1})" if where is not None else ""
        raise ValueError(f"space {path}: is no YAML file{line}") from None


def _parameter(entry: object, place: int) -> Parameter:
    if not isinstance(entry, Mapping) or not isinstance(entry.get("name"), str) or not entry["name"]:
        raise ValueError(f"parameters[{place}]: needs a name, e.g. {{name: height, type: float, low: 5, high: 20}}")
    name = entry["name"]
    if name == "seed":
        raise ValueError("parameter 'seed': the seed comes with every request and is never searched; leave it out")
    unknown = [str(key) for key in entry if key not in KEYS]
    if unknown:
        raise ValueError(f"parameter {name!r}: has {', '.join(unknown)}; it may have {', '.join(KEYS)}")
    kind, log = entry.get("type", "float"), entry.get("log", False)
    if kind not in TYPES:
        raise ValueError(f"parameter {name!r}: type must be one of {', '.join(TYPES)}, got {kind!r}")
    if not isinstance(log, bool):
        raise ValueError(f"parameter {name!r}: log must be true or false, got {log!r}")
    unit, doc = (str(entry.get(key) or "") for key in ("unit", "doc"))
    if kind in ("bool", "choice"):
        return _switch(name, kind, entry, unit, doc)
    low, high = (_number(entry, key, name, kind == "int") for key in ("low", "high"))
    if log and low <= 0:
        raise ValueError(f"parameter {name!r}: a log scale needs low > 0, got {low:g}")
    middle = math.sqrt(low * high) if log else (low + high) / 2
    default = _scalar(entry.get("default", round(middle) if kind == "int" else middle), name)
    return Parameter(name, low, high, default, scale="log" if log else "linear", kind=kind, unit=unit, doc=doc)


def _switch(name: str, kind: str, entry: Mapping[object, object], unit: str, doc: str) -> Parameter:
    """Parameter without a range: true or false, or one of several words."""
    if "low" in entry or "high" in entry:
        raise ValueError(f"parameter {name!r}: a {kind} has no low and high")
    if kind == "bool":
        return Parameter(name, default=_scalar(entry.get("default", False), name), kind=kind, unit=unit, doc=doc)
    choices = entry.get("choices")
    if not isinstance(choices, list) or not all(isinstance(choice, str) for choice in choices):
        raise ValueError(f"parameter {name!r}: a choice needs choices, a list of texts (in quotes), got {choices!r}")
    default = _scalar(entry.get("default", choices[0] if choices else ""), name)
    return Parameter(name, default=default, kind=kind, choices=tuple(choices), unit=unit, doc=doc)


def _constant(name: str, value: Value) -> Parameter:
    """Parameter of a `fixed` name that is in no list: it takes the one value that it has."""
    if isinstance(value, bool):
        return Parameter(name, default=value, kind="bool")
    if isinstance(value, str):
        return Parameter(name, default=value, kind="choice", choices=(value, f"not {value}"))
    kind = "int" if isinstance(value, int) else "float"
    return Parameter(name, value, value + 1, value, kind=kind)


def _number(entry: Mapping[object, object], key: str, name: str, whole: bool) -> float:
    value = entry.get(key)
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise ValueError(f"parameter {name!r}: {key} must be a number, got {value!r}")
    if whole and value != int(value):
        raise ValueError(f"parameter {name!r}: {key} must be a whole number, got {value!r}")
    return int(value) if whole else float(value)


def _scalar(value: object, place: str) -> Value:
    if not isinstance(value, bool | int | float | str) or (isinstance(value, float) and not math.isfinite(value)):
        raise ValueError(f"{place}: must be a number, a text, true or false, got {value!r}")
    return value
