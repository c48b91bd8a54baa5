"""Compare: the settings of the task compare, with their types and ranges."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import Annotated

from pydantic import BeforeValidator, ConfigDict, Field, field_validator
from pydantic.dataclasses import dataclass

Name = Annotated[str, BeforeValidator(lambda value: str(value) if isinstance(value, int | float) else value)]
FileName = Annotated[str, Field(pattern=r"^\w[\w.-]*$")]
"""Name that becomes part of a file's name."""

Count = Annotated[int, Field(ge=1)]
Setting = bool | int | float | str | None


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Compare:
    """What the task compare compares: optimisers by generators by pictures by repeats.

    Optimisers are names of conf/optimizer or of `variants`, which say their `base` there and what they have otherwise;
    `baselines` are further ones, on the first of the generators only. The first optimiser is the one that the others
    are compared with; the stronger of those of `reference` sets the score to be reached.
    """

    optimizers: Annotated[tuple[FileName, ...], Field(min_length=1)] = ("treefit", "tree_ga", "tree_ga_authors")
    baselines: tuple[FileName, ...] = ()
    variants: Mapping[FileName, Mapping[str, Setting]] = field(default_factory=dict)
    generators: Annotated[tuple[FileName, ...], Field(min_length=1)] = ("simplegen",)
    masks: Name | None = None
    hidden: Annotated[int, Field(ge=0, le=1000)] = 6
    repeats: Annotated[int, Field(ge=1, le=1000)] = 3
    evaluations: Count = 50_000
    budgets: Annotated[tuple[Count, ...], Field(min_length=1)] = (1_000, 2_500, 5_000, 10_000, 25_000, 50_000)
    reference: tuple[FileName, ...] = ("tree_ga", "tree_ga_authors")
    workers: Annotated[int, Field(ge=0, le=1024)] = 0
    renew: bool = False

    @field_validator("optimizers", "baselines", "generators")
    @classmethod
    def _once(cls, names: tuple[str, ...]) -> tuple[str, ...]:
        return tuple(dict.fromkeys(names))

    def optimizers_on(self, generator: str) -> tuple[str, ...]:
        """Names of the optimisers that are run on `generator`."""
        more = self.baselines if generator == self.generators[0] else ()
        return tuple(dict.fromkeys(self.optimizers + more))

    @property
    def columns(self) -> tuple[int, ...]:
        """Budgets of the table: those that a run has, and all that it has."""
        return (*sorted({budget for budget in self.budgets if budget < self.evaluations}), self.evaluations)
