"""Settings of task=adapt: which example it starts from, and how many trees it tries."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator, ConfigDict, Field
from pydantic.dataclasses import dataclass

File = Annotated[str, BeforeValidator(lambda value: str(value) if isinstance(value, int | float) else value)]


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Adapt:
    """An `example` of all values, asked of the program when None; `plants` random trees are tried.

    On `moved` of those each parameter goes through its range; one that changes less than the share `threshold` of the
    picture of every tree is fixed. plants.png shows `shown` trees. `ranges` keep tries those of the
    generator's space file as they are; auto does so where the user has named one and no example.
    """

    example: File | None = None
    ranges: Literal["auto", "propose", "keep"] = "auto"
    plants: Annotated[int, Field(ge=20, le=100_000)] = 200
    moved: Annotated[int, Field(ge=1, le=100)] = 4
    threshold: Annotated[float, Field(ge=0, le=1)] = 0.03
    shown: Annotated[int, Field(ge=1, le=200)] = 24
