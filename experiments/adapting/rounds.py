"""Rounds of the task adapt: random trees of the ranges, narrower ones as long as too few of them grow."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from experiments.adapting.beginning import Foreign
from experiments.adapting.ends import failing_ends, reasons
from experiments.adapting.narrow import narrowed
from experiments.adapting.ranges import Proposal
from experiments.adapting.space import as_space
from experiments.adapting.trial import ENOUGH, Tree, Trial, joined, try_genomes, try_values
from experiments.errors import UserError
from experiments.terminal import patience
from treefit.plant import Generator

ROUNDS = 3
"""Spaces that are tried at the most."""

FIRST = 20
"""Trees of which one has to grow, or the example: else no more are tried."""


@dataclass(frozen=True)
class Round:
    """A space of which too few genomes grew: their share, the failures by kind, what became narrower after it."""

    share: float
    failures: Sequence[tuple[int, str, str]]
    narrowed: Sequence[str]


@dataclass(frozen=True, eq=False)
class Tried:
    """Proposals after the last round, their generator and trial, the example's tree, and the rounds before."""

    proposals: Sequence[Proposal]
    generator: Generator
    trial: Trial
    example: Tree
    before: Sequence[Round]


def try_rounds(foreign: Foreign, proposals: Sequence[Proposal], plants: int, seed: int, rounds: int = ROUNDS) -> Tried:
    """Try `plants` random genomes of the proposals; narrow them up to `rounds` - 1 times where under 80 % grow.

    UserError with the first reason when nothing at all grows.
    """
    generator = foreign.with_space(as_space(proposals))
    with patience("growing the example; the first run on a machine also compiles kernels"):
        example = try_values(generator, ({one.name: one.value for one in proposals if not one.left_out}, seed))
    before: list[Round] = []
    while True:
        trial = try_space(generator, plants, seed, example)
        if trial.share >= ENOUGH or len(before) + 1 == rounds:
            break
        ends = {name: end.at_fault for name, end in failing_ends(trial).items() if end.at_fault}
        closer = narrowed(proposals, ends)
        if closer == list(proposals) or not any(one.searched for one in closer):
            break
        changed = [one.name for one, two in zip(proposals, closer, strict=True) if one != two]
        before.append(Round(trial.share, reasons(trial), changed))
        proposals = closer
        generator = foreign.with_space(as_space(proposals))
    if not trial.good:
        raise UserError(f"generator: none of {plants} random trees grew{_why(trial)}")
    return Tried(proposals, generator, trial, example, before)


def try_space(generator: Generator, plants: int, seed: int, example: Tree) -> Trial:
    """Trial of `plants` random genomes; UserError when neither the `example` nor one of the first of them grows."""
    first = try_genomes(generator, range(seed, seed + min(FIRST, plants)), "random trees")
    if not first.good and not example.grew:
        raise UserError(f"generator: neither the example nor {len(first.trees)} random trees grew{_why(first)}")
    if plants <= FIRST:
        return first
    return joined(first, try_genomes(generator, range(seed + FIRST, seed + plants), "random trees"))


def _why(trial: Trial) -> str:
    count, kind, first = reasons(trial)[0]
    return f": {kind} ({count} times): {first}"
