"""Ranges that are proposed for the parameters of a foreign generator, from one example of their values and their names.

| value in the example | name says (last word first)  | proposed                                                       |
|----------------------|------------------------------|----------------------------------------------------------------|
| any                  | seed                         | left out: the seed comes with every request                    |
| any                  | colour, texture ...          | fixed: no mask sees it                                         |
| whole number         | resolution, segments ...     | fixed: detail                                                  |
| with low, high       | any                          | what the program itself says                                   |
| text                 | any                          | fixed; a choice when the program names its choices             |
| true, false          | any                          | bool                                                           |
| whole, 1 to 6        | levels, depth ...            | one less to one more, from 1: each level is many times as many |
| 0 to 1               | probability, ratio, share .. | 0 to 1 (from 0.05 on: less is a number of its own scale)       |
| -1 to 1              | direction                    | 0.5 less to 0.5 more, within -1 to 1                           |
| over a full turn's 6.3 radians | angle, twist ...   | 30 degrees less to 30 more, an angle over 0 stays so           |
| 0                    | count                        | 0 to 2                                                         |
| 0                    | any other                    | the range of its like in the same list; fixed when it has none |
| under 0              | any                          | twice as far to both sides                                     |
| whole, 1 to 4        | no measure                   | two less (from 0) to two more                                  |
| whole, over 4        | no measure                   | half to twice, from 8 on as a logarithm                        |
| 0 to 1               | no size                      | half to twice, 1 at the most                                   |
| over 0               | any                          | half to twice, as a logarithm                                  |

JSON of many languages has no 20.0: a whole number whose name says size, angle or share, or whose like in the same list
is not whole, is taken as a float.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from experiments.adapting.example import Example, Hint
from experiments.adapting.hints import hinted
from experiments.adapting.names import family, says
from treefit.plant import Parameter, Value

FULL_TURN = 2 * math.pi
"""What an angle is over is surely in degrees."""

SWING = 30.0
"""Degrees that an angle goes to both sides."""

BESIDE = 0.5
"""How far a part of a direction goes to both sides."""

LEAST_SHARE = 0.05
FEW, MANY, MOST_LEVELS = 4, 8, 6

LOOK, DETAIL = "colour and texture: no mask sees them", "detail of the mesh or the curves, not of the tree"
TEXT, ZERO = "a text: {value, choices} in the preset make it a choice", "0 says nothing of a range: give it one"
SEED = "the seed: it comes with every request"


@dataclass(frozen=True)
class Proposal:
    """A parameter of the example with `value`: `searched` in the range of `parameter`, else fixed.

    `reason` says why it is fixed, or where its range is from. One that is fixed may have a range all the same, for who
    wants to search it; a seed is `left_out`, neither searched nor fixed.
    """

    name: str
    value: Value
    parameter: Parameter | None = None
    reason: str = ""
    left_out: bool = False
    searched: bool = False


def propose(example: Example) -> list[Proposal]:
    """Return a proposal for each value of `example`, in its order."""
    floats = {family(name) for name, value in example.values.items() if isinstance(value, float)}
    own = {name: _one(name, value, example.hints.get(name, {}), family(name) in floats)
           for name, value in example.values.items()}  # fmt: skip
    return [_like_its_list(proposal, own) for proposal in own.values()]


def _one(name: str, value: Value, hint: Hint, as_float: bool) -> Proposal:
    told = says(name)
    if told[:1] == ["seed"]:
        return Proposal(name, value, reason=SEED, left_out=True)
    if hint:
        return _proposal(name, value, *hinted(name, value, hint))
    if "look" in told:
        return Proposal(name, value, reason=LOOK)
    if isinstance(value, bool):
        return _proposal(name, value, Parameter(name, default=value, kind="bool"))
    if isinstance(value, str):
        return Proposal(name, value, reason=TEXT)
    whole = isinstance(value, int) or (value == int(value) and told[:1] in (["count"], ["level"]))
    if whole and told[:1] == ["detail"]:
        return Proposal(name, value, reason=DETAIL)
    measured = as_float or told[:1] in (["size"], ["angle"], ["share"], ["direction"])
    parameter = _count(name, int(value), told) if whole and not measured else _number(name, float(value), told)
    return _proposal(name, value, parameter, "" if parameter else ZERO)


def _proposal(name: str, value: Value, parameter: Parameter | None, reason: str = "") -> Proposal:
    return Proposal(name, value, parameter, reason, searched=parameter is not None)


def _count(name: str, value: int, told: list[str]) -> Parameter | None:
    """Range of a whole number."""
    if told[:1] == ["level"] and 1 <= value <= MOST_LEVELS:
        return _whole(name, max(1, value - 1), value + 1, value)
    if value == 0:
        return _whole(name, 0, 2, 0) if told[:1] == ["count"] else None
    if value < 0:
        return _whole(name, 2 * value, -2 * value, value)
    if value <= FEW:
        return _whole(name, max(0, value - 2), value + 2, value)
    return _whole(name, value // 2, 2 * value, value, log=value >= MANY)


def _number(name: str, value: float, told: list[str]) -> Parameter | None:
    """Range of a float."""
    first = told[0] if told else ""
    if first == "direction" and abs(value) <= 1:
        return Parameter(name, max(value - BESIDE, -1), min(value + BESIDE, 1), value)
    if first == "share" and (value == 0 or LEAST_SHARE <= value <= 1):
        return Parameter(name, 0, 1, value)
    if "angle" in told[:2] and abs(value) > FULL_TURN:
        low = value - SWING if value < 0 else max(0.0, value - SWING)
        return Parameter(name, low, value + SWING, value, unit="deg")
    if value == 0:
        return None
    if value < 0:
        return Parameter(name, 2 * value, -2 * value, value)
    if value < 1 and first != "size":
        return Parameter(name, value / 2, min(2 * value, 1.0), value, scale="log")
    return Parameter(name, value / 2, 2 * value, value, scale="log")


def _whole(name: str, low: int, high: int, value: int, log: bool = False) -> Parameter:
    return Parameter(name, low, high, value, scale="log" if log else "linear", kind="int")


def _like_its_list(proposal: Proposal, own: Mapping[str, Proposal]) -> Proposal:
    """Give a 0 without a range that of the others in its list, made wider so that 0 is in it."""
    if proposal.reason != ZERO:
        return proposal
    like = [
        other.parameter for other in own.values() if family(other.name) == family(proposal.name) and other.parameter
    ]
    like = [parameter for parameter in like if parameter.kind in ("float", "int")]
    if not like:
        return proposal
    low, high = min(0.0, *(one.low for one in like)), max(0.0, *(one.high for one in like))
    whole = all(one.kind == "int" for one in like)
    parameter = Parameter(proposal.name, low, high, 0 if whole else 0.0, like[0].unit, kind="int" if whole else "float")
    return _proposal(proposal.name, proposal.value, parameter, "0, with the range of its list")
