"""Bounds: what a user wishes of a number: a value, a range, a least or a most."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

Wish = float | Sequence[float] | Mapping[str, float | None]
"""A number, [low, high], or {min: low, max: high} of which either may be left out."""

FORMS = "a number, a range [low, high] or {min: low, max: high}"


@dataclass(frozen=True)
class Bounds:
    """From `low` to `high`, both included; `high` is infinite when there is none, `low` is 0."""

    low: float
    high: float

    def __post_init__(self) -> None:
        if not 0 <= self.low <= self.high:
            raise ValueError(f"min must not be above max, got {self.low:g} and {self.high:g}")

    def __str__(self) -> str:
        """In words: "3000", "2000 to 4000", "at most 5000", "at least 100"."""
        if self.low == self.high:
            return f"{self.low:.12g}"
        if math.isinf(self.high):
            return f"at least {self.low:.12g}"
        return f"{self.low:.12g} to {self.high:.12g}" if self.low > 0 else f"at most {self.high:.12g}"

    @property
    def bounded(self) -> bool:
        """Whether there is a most."""
        return math.isfinite(self.high)

    @property
    def middle(self) -> float:
        """One number for all of them: the geometric middle of a range, otherwise the most or the least."""
        if not self.bounded:
            return self.low
        return math.sqrt(self.low * self.high) if self.low > 0 else self.high


def bounds_of(wish: object, whole: bool = False, least: float = 0.0) -> Bounds:
    """Bounds of a Wish; ValueError for anything else.

    Its numbers must be over 0, at least `least`, and with `whole` whole ones.
    """
    if isinstance(wish, Bounds):
        return wish
    if isinstance(wish, Mapping):
        unknown = [str(key) for key in wish if key not in ("min", "max")]
        given = {str(key): _number(value, whole, least) for key, value in wish.items() if value is not None}
        if unknown or not given:
            raise ValueError(f"must be {FORMS}, got {dict(wish)!r}")
        return Bounds(given.get("min", 0.0), given.get("max", math.inf))
    if isinstance(wish, Sequence) and not isinstance(wish, str):
        if len(wish) != 2:
            raise ValueError(f"must be {FORMS}, got {list(wish)!r}")
        low, high = (_number(value, whole, least) for value in wish)
        return Bounds(low, high)
    number = _number(wish, whole, least)
    return Bounds(number, number)


def share_within(value: float, low: float, high: float) -> float:
    """1 inside of the bounds, else min / max of `value`, which is not negative, and the nearest bound (sec. 4)."""
    if low <= value <= high:
        return 1.0
    near = low if value < low else high
    return min(value, near) / max(value, near)


def _number(value: object, whole: bool, least: float) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise ValueError(f"must be {FORMS}, got {value!r}")
    if value <= 0:
        raise ValueError(f"must be greater than 0, got {value!r}")
    if value < least:
        raise ValueError(f"must be greater than or equal to {least:g}, got {value!r}")
    if whole and value != int(value):
        raise ValueError(f"must be a whole number, got {value!r}")
    return value
