"""Rows of a growth strip: where each trunk stands, so that plants have their room and rows are of one width."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Place:
    """Room that a plant takes left and right of its trunk, in pixels."""

    left: float
    right: float


@dataclass(frozen=True)
class Row:
    """Places `first` to `last` (exclusive) in one row of `width` pixels.

    `trunks` are columns; `halves` is the lesser of the two rooms of each place.
    """

    first: int
    last: int
    width: int
    trunks: tuple[float, ...]
    halves: tuple[float, ...]


def arranged(places: Sequence[Place], margins: tuple[float, float], widest: float, narrowest: float) -> list[Row]:
    """As few rows as can be, about equally full, of one width up to `widest`; `margins` are left and right in each."""
    room = widest - sum(margins)
    count = len(_broken(places, room))
    low, high = max(place.left + place.right for place in places), max(room, 0.0)
    for _ in range(20):  # the narrowest rows that are no more
        middle = (low + high) / 2
        low, high = (low, middle) if len(_broken(places, middle)) <= count else (middle, high)
    parts = _broken(places, high)
    width = max(sum(margins) + max(_taken(places[first:last]) for first, last in parts), narrowest)
    return [_row(places, first, last, margins, round(width)) for first, last in parts]


def _broken(places: Sequence[Place], room: float) -> list[tuple[int, int]]:
    """Rows (first, last), each filled until the next place has no room."""
    rows, first, taken = [], 0, 0.0
    for i, place in enumerate(places):
        wide = place.left + place.right
        if i > first and taken + wide > room:
            rows.append((first, i))
            first, taken = i, 0.0
        taken += wide
    return [*rows, (first, len(places))]


def _taken(places: Sequence[Place]) -> float:
    return sum(place.left + place.right for place in places)


def _row(places: Sequence[Place], first: int, last: int, margins: tuple[float, float], width: int) -> Row:
    """A row whose spare room is shared by its places."""
    own = places[first:last]
    spare = max(width - sum(margins) - _taken(own), 0.0) / len(own)
    trunks, x = [], margins[0]
    for place in own:
        trunks.append(x + spare / 2 + place.left)
        x += spare + place.left + place.right
    return Row(first, last, width, tuple(trunks), tuple(min(place.left, place.right) + spare / 2 - 2 for place in own))
