"""Example of all values of a foreign generator: nested tables and lists become flat names, as requests have them."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from experiments.errors import UserError
from treefit.plant import Value

KNOWN = ("value", "choices", "low", "high", "log", "unit", "doc")
"""What a program may say of a parameter: a table with `value` and any of the others, in place of the bare value."""

Hint = Mapping[str, object]


@dataclass(frozen=True)
class Example:
    """Values by flat name ("branch.length.0"), hints by the same names, and a line for everything left out."""

    values: Mapping[str, Value]
    hints: Mapping[str, Hint] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def read_example(path: Path) -> Example:
    """Return the example in the JSON file `path`; UserError with one line when it is none."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise UserError(f"adapt.example: {path} cannot be read: {error.strerror}") from None
    except json.JSONDecodeError as error:
        raise UserError(f"adapt.example: {path} is no JSON file (line {error.lineno}: {error.msg})") from None
    except (ValueError, RecursionError):
        raise UserError(f"adapt.example: {path} is no JSON file") from None
    return flattened(content, f"adapt.example: {path}")


def flattened(content: object, place: str) -> Example:
    """Example of nested tables and lists; UserError, which begins with `place`, when there is no value in them."""
    if not isinstance(content, Mapping):
        raise UserError(f'{place}: must be a table of names and values, {{"height": 9.5, ...}}, got {content!r:.60}')
    values: dict[str, Value] = {}
    hints: dict[str, Hint] = {}
    notes: list[str] = []
    for name, value, hint in _leaves(content, ""):
        if name in values:
            raise UserError(f"{place}: has two values of the name {name}")
        if isinstance(value, bool | str | int) or (isinstance(value, float) and math.isfinite(value)):
            values[name] = value
            hints.update({name: hint} if hint else {})
        else:
            notes.append(f"{name}: {value!r:.40} is no number, text, true or false")
    if not values:
        raise UserError(f"{place}: has no number, text, true or false")
    return Example(values, hints, tuple(notes))


def _leaves(node: object, name: str) -> Iterator[tuple[str, object, Hint]]:
    """Yield each flat name with its value and what else is known of it."""
    if isinstance(node, Mapping) and name and "value" in node and set(node) <= set(KNOWN):
        yield name, node["value"], {str(key): node[key] for key in node if key != "value"}
    elif isinstance(node, Mapping):
        for key, value in node.items():
            yield from _leaves(value, f"{name}.{key}" if name else str(key))
    elif isinstance(node, list):
        for i, value in enumerate(node):
            yield from _leaves(value, f"{name}.{i}")
    else:
        yield name, node, {}
