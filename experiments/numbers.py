"""Numbers for people: as many digits as mean something."""

from __future__ import annotations

from collections.abc import Mapping

DIGITS = 3


def rounded(value: object, digits: int = DIGITS) -> object:
    """`value` with every float in it at `digits` significant digits."""
    if isinstance(value, float):
        return float(f"{value:.{digits}g}")
    if isinstance(value, Mapping):
        return {name: rounded(one, digits) for name, one in value.items()}
    return [rounded(one, digits) for one in value] if isinstance(value, list | tuple) else value
