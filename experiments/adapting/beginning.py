"""What the task adapt begins from: an example of the user's or of the program, or a space that there is already."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, cast, runtime_checkable

from experiments.adapting.example import flattened, read_example
from experiments.adapting.ranges import Proposal, propose
from experiments.adapting.settings import Adapt
from experiments.adapting.space import given, of_space
from experiments.errors import UserError, one_line
from treefit.plant import Generator, ParameterSpace, Value

NO_EXAMPLE = (
    "adapt.example: {name} tells no preset; give adapt.example=preset.json, or let it answer "
    '{{"id": 0, "ask": "preset"}} with {{"id": 0, "ok": true, "values": {{...}}}}'
)


@runtime_checkable
class Foreign(Protocol):
    """What the task asks of a foreign generator, besides that it grows plants."""

    def ask_preset(self) -> Mapping[str, object] | None:
        """Return values of an example plant, None when it tells none."""

    def with_space(self, space: ParameterSpace) -> Generator:
        """Return the same generator with another space."""


@dataclass(frozen=True)
class Beginning:
    """Proposals from a `source`; those that are `kept` are the user's own, to be tried as they are."""

    source: str
    proposals: Sequence[Proposal]
    notes: Sequence[str] = ()
    kept: bool = False


def beginning(generator: Foreign, settings: Adapt, own_space: bool, fixed: Mapping[str, Value]) -> Beginning:
    """Return where the ranges of `generator` begin; `own_space`: the user has named a space file for it.

    UserError when there is neither a preset of the program nor an example.
    """
    if settings.ranges == "keep" or (settings.ranges == "auto" and own_space and settings.example is None):
        return _kept(generator, fixed)
    if settings.example is not None:
        source, example = Path(settings.example).name, read_example(Path(settings.example))
    else:
        source, told = "the program's preset", generator.ask_preset()
        if told is None:
            raise UserError(NO_EXAMPLE.format(name=cast(Generator, generator).name))
        example = flattened(told, "the preset of the program")
    proposals = given(propose(example), fixed)
    return Beginning(source, proposals, example.notes)


def _kept(generator: Foreign, fixed: Mapping[str, Value]) -> Beginning:
    try:
        space = cast(Generator, generator).space
    except ValueError as error:
        raise UserError(one_line(error)) from error
    return Beginning("the space file", given(of_space(space), fixed), kept=True)
