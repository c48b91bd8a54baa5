"""What a row of the parameter sheet shows: which parameters, at which values, and how a value is written."""

from __future__ import annotations

from collections.abc import Sequence

from experiments.errors import UserError, did_you_mean
from treefit.plant import Parameter, ParameterSpace, Value

STEPS = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Genes at which a number is shown."""

_BARE = ("", "1", "share")  # units that are not written behind a number


def choose(space: ParameterSpace, names: Sequence[str] | None) -> tuple[Parameter, ...]:
    """Parameters of `space` by name in its own order, all of them when `names` is None; UserError for a wrong name."""
    known = [parameter.name for parameter in space.parameters]
    for name in names or ():
        if name not in known:
            raise UserError(f"sheet.names: no parameter {name!r}{did_you_mean(name, known)}")
    return tuple(parameter for parameter in space.parameters if names is None or parameter.name in names)


def steps(parameter: Parameter) -> list[Value]:
    """Values from low to high in equal steps of the gene, without repetition; every one of a choice or a bool."""
    if parameter.kind == "choice":
        return list(parameter.choices)
    if parameter.kind == "bool":
        return [False, True]
    return list(dict.fromkeys(parameter.decode(gene) for gene in STEPS))


def nearest(parameter: Parameter, values: Sequence[Value], value: Value) -> int:
    """Index of that of `values` whose gene is nearest to that of `value`."""
    gene = parameter.encode(value)
    return min(range(len(values)), key=lambda i: abs(parameter.encode(values[i]) - gene))


def written(value: Value, unit: str) -> str:
    """`value` for people: three digits, a real minus sign, its unit where it has one."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    number = f"{value:,.0f}" if isinstance(value, int) or abs(value) >= 1000 else f"{value:.3g}"
    number = number.replace("-", "−")
    if unit in _BARE:
        return number
    return f"{number}°" if unit == "deg" else f"{number} {unit}"
