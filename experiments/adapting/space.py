"""Proposals become the content of a space file, and the space that it is read as."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from experiments.adapting.effects import Effect
from experiments.adapting.ranges import Proposal
from experiments.errors import blame
from generators.external.space import space_of
from treefit.plant import Parameter, ParameterSpace, Value

DEAD, SIZE = "changes no picture", "scales the whole tree, which no picture shows"
GIVEN, KEPT = "as generator.fixed says", "as the space file says"

Entry = dict[str, Value | list[str]]


def as_space(proposals: Sequence[Proposal]) -> ParameterSpace:
    """Space of `proposals`, as it is read from the file that they are written to; UserError when it has no gene."""
    with blame("the proposed space"):
        return space_of({
            "parameters": [entry(one.parameter) for one in proposals if one.parameter is not None],
            "fixed": fixed_of(proposals),
        })  # fmt: skip


def entry(parameter: Parameter) -> Entry:
    """What a space file says of a parameter."""
    found: Entry = {"name": parameter.name, "type": parameter.kind}
    if parameter.kind == "int":
        found |= {"low": int(parameter.low), "high": int(parameter.high)}
    if parameter.kind == "float":
        found |= {"low": _short(parameter.low), "high": _short(parameter.high)}
    if parameter.scale == "log":
        found["log"] = True
    found["default"] = parameter.default
    if parameter.kind == "choice":
        found["choices"] = list(parameter.choices)
    return found | {key: text for key, text in (("unit", parameter.unit), ("doc", parameter.doc)) if text}


def fixed_of(proposals: Sequence[Proposal]) -> dict[str, Value]:
    """Values by name of those that are not searched."""
    return {one.name: one.value for one in proposals if not one.searched and not one.left_out}


def of_space(space: ParameterSpace) -> list[Proposal]:
    """Return the parameters of a space that there is, with their defaults in place of an example."""
    return [
        Proposal(one.name, space.fixed[one.name], one, KEPT, searched=False)
        if one.name in space.fixed
        else Proposal(one.name, one.default, one, searched=True)
        for one in space.parameters
    ]


def given(proposals: Sequence[Proposal], fixed: Mapping[str, Value]) -> list[Proposal]:
    """Proposals with the values that the user has fixed, of further parameters too."""
    own = {one.name: one for one in proposals if not one.left_out}
    wanted = {name: Proposal(name, value, reason=GIVEN) for name, value in fixed.items()}
    return [wanted.get(one.name, one) for one in proposals] + [wanted[name] for name in wanted if name not in own]


def judged(proposals: Sequence[Proposal], effects: Mapping[str, Effect], threshold: float) -> list[Proposal]:
    """Proposals of which those are fixed that change less of every picture than `threshold`; their ranges stay."""
    found = []
    for one in proposals:
        effect = effects.get(one.name)
        if effect is None or not effect.tried:
            found.append(one)
        elif effect.scales:
            found.append(replace(one, reason=SIZE, searched=False))
        else:
            found.append(replace(one, reason=DEAD, searched=False) if effect.most < threshold else one)
    return found


def _short(number: float) -> float:
    """A bound of a range with as many digits as people write."""
    return float(f"{number:.4g}")
