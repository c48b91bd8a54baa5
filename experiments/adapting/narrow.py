"""Narrower ranges around the example, for generators that fail in too much of the first ones."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from experiments.adapting.ranges import Proposal
from treefit.plant import Parameter

NARROWED = "nothing but the example's value grew well"


def narrowed(proposals: Sequence[Proposal], ends: Mapping[str, str]) -> list[Proposal]:
    """Proposals halved around their values: those named in `ends` ("low", "high": the end that fails), or all of them.

    A range of which no other whole number is left becomes fixed; what is no number stays.
    """
    return [_narrow(proposal, ends.get(proposal.name, "none" if ends else "both")) for proposal in proposals]


def _narrow(proposal: Proposal, end: str) -> Proposal:
    parameter = proposal.parameter
    if parameter is None or not proposal.searched or end == "none" or parameter.kind not in ("float", "int"):
        return proposal
    low = halfway(parameter, 0.0) if end in ("low", "both") else parameter.low
    high = halfway(parameter, 1.0) if end in ("high", "both") else parameter.high
    if low >= high:
        return replace(proposal, parameter=None, reason=NARROWED, searched=False)
    return replace(proposal, parameter=replace(parameter, low=low, high=high))


def halfway(parameter: Parameter, end: float) -> float:
    """Value halfway from the end 0 or 1 of the gene to the default; of whole numbers the next one nearer to it."""
    value = float(parameter.default)
    if parameter.kind == "int":
        bound = parameter.low if end == 0 else parameter.high
        middle = (bound + value) / 2
        return math.floor(middle) if value < middle else math.ceil(middle)
    decoded = parameter.decode((parameter.encode(parameter.default) + end) / 2)
    assert not isinstance(decoded, str)
    return float(decoded)
