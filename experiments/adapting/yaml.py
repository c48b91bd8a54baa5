"""File space.yaml of the task adapt: the proposed space, with a comment on what is known of each parameter."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

import yaml

from experiments.adapting.findings import Findings
from experiments.adapting.ranges import Proposal
from experiments.adapting.space import entry


def space_text(found: Findings, command: str) -> str:
    """Text of the space file; `command` is that which uses it."""
    return "\n".join([*_head(found, command), "parameters:", *_parameters(found), *_fixed(found), ""])


def _head(found: Findings, command: str) -> Iterator[str]:
    grew, tried, seconds = len(found.trial.good), len(found.trial.trees), found.seconds
    yield _comment(f"Parameters of {found.generator} {found.version}, proposed by task=adapt from {found.source}.")
    yield _comment(f"Run:  {command}")
    yield _comment(f"{grew} of {tried} random trees of these ranges grew; a call takes {seconds['median']:.3g} s, "
                   f"95 % of them under {seconds['p95']:.3g} s.")  # fmt: skip
    yield "# A parameter changes as much of a tree's picture as is said when it alone goes through its range."
    for proposal in found.proposals:
        if proposal.left_out:
            yield _comment(f"Left out: {proposal.name}, {proposal.reason}.")
    for note in found.notes:
        yield _comment(f"Left out: {note}.")


def _parameters(found: Findings) -> Iterator[str]:
    for proposal in found.proposals:
        if proposal.parameter is not None:
            yield f"  {_comment('; '.join(remarks(found, proposal)))}"
            yield f"  - {_flow(entry(proposal.parameter))}"


def remarks(found: Findings, proposal: Proposal) -> Iterator[str]:
    """Yield what is known of a parameter: its value in the example, its effect, where trees fail."""
    effect, ends = found.effects.get(proposal.name), found.ends.get(proposal.name)
    yield f"example {_flow(proposal.value)}"
    if effect is not None:
        most = f", {effect.most:.0%} at the most" if effect.most - effect.mean >= 0.01 else ""
        yield f"changes {effect.mean:.0%} of the picture{most}" if effect.tried else "no tree grew when it was moved"
    if ends is not None and ends.at_fault:
        yield f"{ends.low:.0%} fail when it is low, {ends.high:.0%} when it is high"
    if proposal.searched and proposal.reason:
        yield proposal.reason


def _fixed(found: Findings) -> Iterator[str]:
    if not found.fixed:
        return
    yield "fixed:  # not searched; one that is in the list above is searched when its line here is taken out"
    for reason, group in groupby(sorted(found.fixed, key=lambda one: one.reason), key=lambda one: one.reason):
        yield f"  {_comment(reason)}"
        for proposal in group:
            yield f"  {_flow(proposal.name)}: {_flow(proposal.value)}"


def _comment(text: str) -> str:
    """`text` as a comment on one line, without signs that YAML does not take."""
    return "# " + "".join(sign if sign.isprintable() else " " for sign in text)


def _flow(value: object) -> str:
    """`value` on one line, as YAML reads it back."""
    text = yaml.safe_dump(value, default_flow_style=True, sort_keys=False, allow_unicode=True, width=float("inf"))
    return text.removesuffix("\n").removesuffix("\n...")
