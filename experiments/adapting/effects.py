"""Effects of single parameters: how much of the picture changes when one goes through its range and all else stays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from experiments.adapting.trial import Tree, at_once, try_values
from treefit.plant import Generator, Parameter, ParameterSpace, Value
from treefit.view import BitMask

STEPS = (0.0, 0.5, 1.0)
"""Genes at which a number is tried."""

SAME_SIZE, SAME_RATIO = 1e-3, 0.02
"""How near heights of a tree, and ratios of heights and values, are called the same."""


@dataclass(frozen=True)
class Effect:
    """What a parameter does to trees: shares 0 to 1 of their pixels that it changes, on the mean and at the most.

    `scales`: the height is in proportion to the value and the picture stays; None of `tried` values may have grown.
    """

    mean: float
    most: float
    scales: bool
    tried: int


def effects(generator: Generator, space: ParameterSpace, trees: Sequence[Tree]) -> dict[str, Effect]:
    """Effect of each free parameter of `space` on `trees`, by name."""
    moves = [(tree, parameter, value) for parameter in space.free for tree in trees
             for value in _steps(parameter, tree.values[parameter.name])]  # fmt: skip
    jobs = [({**tree.values, parameter.name: value}, tree.seed) for tree, parameter, value in moves]
    moved = at_once(generator, partial(try_values, generator), jobs, "trees with one parameter moved")
    pairs: dict[str, list[tuple[Tree, Tree]]] = {parameter.name: [] for parameter in space.free}
    for (tree, parameter, _), other in zip(moves, moved, strict=True):
        if other.grew:
            pairs[parameter.name].append((tree, other))
    return {name: _effect(name, own) for name, own in pairs.items()}


def difference(one: BitMask, two: BitMask) -> float:
    """Share of the pixels of both trees that are not of the same class in both: 1 - intersection by union."""
    shared = np.bitwise_count(one.branch & two.branch).sum() + np.bitwise_count(one.foliage & two.foliage).sum()
    joined = np.bitwise_count(one.branch | one.foliage | two.branch | two.foliage).sum()
    return 1.0 - float(shared) / float(joined)


def _steps(parameter: Parameter, own: Value) -> list[Value]:
    """Values of a parameter other than a tree's own: the ends and the middle of a number, all others of the rest."""
    if parameter.kind == "choice":
        values: list[Value] = list(parameter.choices)
    elif parameter.kind == "bool":
        values = [False, True]
    else:
        values = [parameter.decode(gene) for gene in STEPS]
    return [value for value in dict.fromkeys(values) if value != own]


def _effect(name: str, pairs: Sequence[tuple[Tree, Tree]]) -> Effect:
    """Effect from pairs of a tree and the same with another value of `name`."""
    if not pairs:
        return Effect(0.0, 0.0, False, 0)
    greatest: dict[int, float] = {}
    for one, two in pairs:
        assert one.mask is not None
        assert two.mask is not None
        greatest[id(one)] = max(greatest.get(id(one), 0.0), difference(one.mask, two.mask))
    most = max(greatest.values())
    scales = most < SAME_RATIO and all(_in_proportion(name, one, two) for one, two in pairs)
    return Effect(float(np.mean(list(greatest.values()))), most, scales, len(pairs))


def _in_proportion(name: str, one: Tree, two: Tree) -> bool:
    """Whether heights differ as the values do, and do differ."""
    values = [_size(tree.values, name) for tree in (one, two)]
    if min(values) <= 0:
        return False
    wanted, found = values[1] / values[0], two.height / one.height
    return abs(found - 1) > SAME_SIZE and abs(found / wanted - 1) < SAME_RATIO


def _size(values: Mapping[str, Value], name: str) -> float:
    value = values[name]
    return 0.0 if isinstance(value, str | bool) else float(value)
