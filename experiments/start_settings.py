"""Settings of where a search begins: the setting `start` and the memory of earlier fits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from pydantic import BeforeValidator, ConfigDict, Field
from pydantic.dataclasses import dataclass


def listed(value: object) -> tuple[object, ...]:
    """Return a list of names; one name is a list of one, None an empty one."""
    if value is None:
        return ()
    return tuple(value) if isinstance(value, Sequence) and not isinstance(value, str) else (value,)


def _named(value: object) -> object:
    return str(value) if isinstance(value, int | float) and not isinstance(value, bool) else value


StartNames = Annotated[
    tuple[Annotated[str, BeforeValidator(_named), Field(min_length=1)], ...], BeforeValidator(listed)
]
"""Files, folders and names of plants."""


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class MemorySettings:
    """Whether fits are remembered in `folder`, at most `size` a generator; the `count` most alike lead a search.

    None of these is farther from the picture than `within` plant heights.
    """

    use: bool = False
    folder: Annotated[str, Field(min_length=1)] = "outputs/memory"
    count: Annotated[int, Field(ge=0, le=100)] = 3
    within: Annotated[float, Field(ge=0)] = 0.2
    size: Annotated[int, Field(ge=1, le=10_000)] = 200
