"""Range that a program itself says of a parameter, beside its value in the preset."""

from __future__ import annotations

from collections.abc import Mapping

from experiments.errors import UserError, one_line
from generators.external.space import space_of
from treefit.plant import Parameter, Value

FROM_PROGRAM = "the program's own range"


def hinted(name: str, value: Value, hint: Mapping[str, object]) -> tuple[Parameter | None, str]:
    """Return the parameter of a hint (low and high, or choices) and why; None when it holds neither: it is fixed.

    UserError when what it says cannot be.
    """
    kind = _kind(value, hint)
    if kind is None:
        return None, "the program says no range of it"
    entry = {"name": name, "type": kind, "default": value, **hint}
    try:
        return space_of({"parameters": [entry]}).parameters[0], FROM_PROGRAM
    except ValueError as error:
        raise UserError(f"the preset of the program: {one_line(error)}") from None


def _kind(value: Value, hint: Mapping[str, object]) -> str | None:
    if "choices" in hint:
        return "choice"
    if isinstance(value, bool):
        return "bool"
    if not isinstance(value, int | float) or not {"low", "high"} <= set(hint):
        return None
    whole = all(isinstance(one, int) for one in (value, hint["low"], hint["high"]))
    return "int" if whole else "float"
