"""Settings of task=check: how many random plants the rules of the contract look at."""

from __future__ import annotations

from typing import Annotated

from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Check:
    """Count of random `plants`, of which `again` are grown several times more."""

    plants: Annotated[int, Field(ge=5, le=500)] = 60
    again: Annotated[int, Field(ge=1, le=500)] = 8
