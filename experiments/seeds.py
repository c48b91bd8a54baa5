"""The setting `seeds`: a number, a list of numbers, or a range of text with its ends, "1..20"."""

from __future__ import annotations

import re
from typing import Annotated

from pydantic import BeforeValidator, Field

MOST = 1000
"""Seeds at most: each is a tree with its files."""


def read_seeds(given: object) -> object:
    """List of seeds that `given` means; ValueError with one line when it means none."""
    if given is None:
        return None
    parts = [_part(part) for part in (given if isinstance(given, list) else [given])]
    count = sum(len(part) for part in parts)
    if not 1 <= count <= MOST:
        raise ValueError(f"must be 1 to {MOST} seeds, got {count}")
    seeds = [seed for part in parts for seed in part]
    if len(set(seeds)) < len(seeds):
        raise ValueError(f"must differ from each other, got {given!r}")
    return seeds


def _part(given: object) -> range:
    text = str(given)
    if isinstance(given, bool) or not (found := re.fullmatch(r"(\d{1,18})(?:\.\.(\d{1,18}))?", text)):
        raise ValueError(f"must be whole numbers from 0, as 1..20 or [1, 2, 5] or 7, got {text!r}")
    first, last = int(found[1]), int(found[2] or found[1])
    if last < first:
        raise ValueError(f"the last of {text} must not be under the first")
    return range(first, last + 1)


SeedList = Annotated[
    tuple[Annotated[int, Field(ge=0, lt=2**63)], ...] | None,
    BeforeValidator(read_seeds),
]
"""Seeds of the variations that the task grow makes; None for one tree."""
