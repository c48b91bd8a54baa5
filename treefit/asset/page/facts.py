"""Facts of a viewer page: tables of one tree, and the parameters of all trees side by side."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class FactRow:
    """One fact: its name, a value for each column of its table, and what it means, told when one points at it."""

    name: str
    values: Sequence[str | float]
    meaning: str = ""


@dataclass(frozen=True)
class FactTable:
    """Facts under one title; `columns` are heads of the values, `folded` shows the title only until it is clicked."""

    title: str
    rows: Sequence[FactRow]
    columns: Sequence[str] = ()
    folded: bool = False


@dataclass(frozen=True)
class ParameterRow:
    """One parameter: a value for each tree, and where in its range [0, 1] each lies, None where it has none."""

    name: str
    values: Sequence[str | float]
    places: Sequence[float | None]
    unit: str = ""
    meaning: str = ""


def plain_table(table: FactTable) -> dict[str, object]:
    """Return a table as the page's script reads it."""
    rows = [{"name": row.name, "meaning": row.meaning, "values": [*map(shown, row.values)]} for row in table.rows]
    return {"title": table.title, "columns": [*table.columns], "folded": table.folded, "rows": rows}


def plain_parameter(row: ParameterRow) -> dict[str, object]:
    """Return a parameter as the page's script reads it; `spread` in [0, 1] is how far its values lie apart."""
    placed = [place for place in row.places if place is not None]
    differs = len({str(value) for value in row.values}) > 1
    spread = max(placed) - min(placed) if placed else float(differs)
    return {
        "name": row.name, "unit": row.unit, "meaning": row.meaning, "values": _apart(row.values),
        "places": [None if place is None else round(place, 4) for place in row.places],
        "differs": differs, "spread": round(spread, 4),
    }  # fmt: skip


def _apart(values: Sequence[str | float]) -> list[str]:
    """Return values as people read them, with so many digits that different ones look different."""
    words = [*map(shown, values)]
    for digits in range(4, 13):
        if len(set(words)) == len(set(values)):
            break
        words = [
            value if isinstance(value, str) else str(value) if isinstance(value, bool | int) else f"{value:.{digits}g}"
            for value in values
        ]
    return words


def shown(value: str | float) -> str:
    """Return a fact as people read it: whole numbers in groups of three, others with three digits."""
    if isinstance(value, str | bool):
        return str(value)
    if not math.isfinite(value):
        return "-"
    if float(value).is_integer():
        return f"{int(value):,}"
    return f"{value:.3f}" if abs(value) < 10 else f"{value:,.1f}"
