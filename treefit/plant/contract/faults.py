"""Faults: how a rule of the contract says that a generator breaks it, and with which values."""

from __future__ import annotations

from treefit.plant.parameters import Value, Values

SHOWN = 4
"""Values that a message has room for."""


class ContractError(ValueError):
    """A rule that must hold is broken; `values` and `seed` are those of a plant that shows it, None when none does."""

    def __init__(self, message: str, values: Values | None = None, seed: int = 0) -> None:
        super().__init__(message if values is None else f"{message}; e.g. {shown(values)}, seed {seed}")
        self.values, self.seed = values, seed


class Shortcoming(ContractError):  # noqa: N818  a warning
    """A rule that should hold is broken; searches work all the same."""


class NotTried(Exception):  # noqa: N818  nothing is wrong with the generator
    """A rule has nothing to be tried on; the message says what is missing."""


def shown(values: Values) -> str:
    """Return the first of `values` on one line: "height=9.5, levels=3 and 4 more"."""
    first = ", ".join(f"{name}={_short(value)}" for name, value in list(values.items())[:SHOWN])
    return f"{first} and {len(values) - SHOWN} more" if len(values) > SHOWN else first


def reason(error: BaseException) -> str:
    """Return kind and message of `error` on one line that is not too long."""
    words = " ".join(str(error).split())
    return f"{type(error).__name__}: {words}"[:300] if words else type(error).__name__


def _short(value: Value) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)
