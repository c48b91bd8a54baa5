"""Errors that are the user's to mend, and how any error becomes one clear line."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from difflib import get_close_matches

from pydantic import ValidationError

DONE, FAILED, WRONG_INPUT = 0, 1, 2
"""Exit status of the program."""


class UserError(ValueError):
    """Wrong input; the message is one line: what, where, what instead."""


def is_input_error(error: BaseException) -> bool:
    """Whether `error` is the user's to mend: a kind of ValueError that this project defines."""
    own = type(error).__module__.startswith(("treefit.", "generators.", "experiments."))
    return isinstance(error, ValueError) and own


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return "; did you mean 'x'?; known: a, b" for a `name` that is not among `known`."""
    names = sorted(known)
    close = get_close_matches(name, names, n=1, cutoff=0.5) or [known for known in names if known.startswith(name)]
    hint = f"; did you mean {close[0]!r}?" if close else ""
    return f"{hint} (there is: {', '.join(names) or 'nothing'})"


def one_line(error: BaseException) -> str:
    """Message of `error` on one line; its type's name when it has no message."""
    return " ".join(str(error).split()) or type(error).__name__


@contextmanager
def blame(place: str) -> Iterator[None]:
    """Turn a ValueError inside the block into a UserError that begins with `place`, the setting at fault."""
    try:
        yield
    except UserError:
        raise
    except ValueError as error:
        raise UserError(f"{place}: {one_line(error)}") from error


def describe_validation(error: ValidationError, place: str, known: Iterable[str] = ()) -> str:
    """First complaint of pydantic in our words: "optimizer.evaluations: must be greater than 0, got -5"."""
    first = error.errors()[0]
    parts = [str(part) for part in first["loc"] if isinstance(part, int) or part.isidentifier()]
    where = ".".join([place, *parts] if place else parts)
    if first["type"] in ("unexpected_keyword_argument", "extra_forbidden"):
        return f"{where}: no such setting{did_you_mean(parts[-1], known)}"
    if first["type"] in ("missing", "missing_argument") or first["input"] is None:
        return f"{where}: must be given"
    rule = first["msg"].removeprefix("Value error, ").removeprefix("Assertion failed, ")
    what, should, must = rule.partition(" should ")
    if not should or " " in what:  # a rule of ours
        return " ".join((f"{where}: {rule}" if where else rule).split())
    must = must.partition(", got ")[0].partition(", unable to")[0].partition(" after validation")[0]
    return f"{where}: must {must}, got {first['input']!r}"
