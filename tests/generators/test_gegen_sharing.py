"""Sharing of GEGen: what an axis is given goes to its buds and branches, all of it and nothing more."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numba import njit
from numpy.typing import NDArray

from generators.gegen.sharing import share
from generators.gegen.tree import AXIS_FLOATS, AXIS_INTS, HEAD, JOINT_FLOATS, JOINT_INTS, MAIN, NEXT, SIDE, Tree

Light = NDArray[np.float32]  # (joints,), of an axis from its base to its tip
FREE = 1e9
"""A bound that bounds nothing."""


@njit
def _share(tree, given, apical, priority, bound, places, amounts, order):
    return share(tree, 0, given, apical, priority, bound, places, amounts, order)


def shared(sides: Light, tip: float, given: float = 10.0, apical: float = 0.1, priority: float = 0.0,
           bound: float = FREE) -> tuple[NDArray[np.int32], Light]:  # fmt: skip
    """Joints that get something for their side, and what they and at last the tip get.

    `sides` is the light to the side of each joint, `tip` that of the tip, `apical` log(lambda / (1 - lambda)).
    """
    n = len(sides)
    tree = Tree(np.zeros((n, JOINT_FLOATS), np.float32), np.zeros((n, JOINT_INTS), np.int32),
                np.zeros((1, AXIS_FLOATS), np.float32), np.zeros((1, AXIS_INTS), np.int32),
                np.zeros(1, np.uint32))  # fmt: skip
    tree.joint[:, SIDE] = sides
    tree.joint[:, MAIN] = tip + sides.sum() - np.cumsum(sides)
    tree.node[:, NEXT] = [*range(1, n), -1]
    tree.stem[0, HEAD] = 0
    lists = np.zeros(n + 1, np.int32), np.zeros(n + 1, np.float32), np.zeros(n + 1, np.int32)
    told = (np.float32(x) for x in (given, math.exp(apical), priority, bound))
    count = _share(tree, *told, *lists)
    return lists[0][: count - 1], lists[1][:count]


def axes(count: int = 60) -> list[tuple[Light, float]]:
    """Random axes: light to the side of their joints, of which some have none, and light of the tip."""
    rng = np.random.default_rng(5)
    found = []
    for _ in range(count):
        sides = rng.random(rng.integers(1, 40)).astype(np.float32) ** 3 * 20
        sides[rng.random(len(sides)) < rng.random()] = 0
        found.append((sides, float(rng.random())))
    return found


@pytest.mark.parametrize("bound", [FREE, 3.0, 0.2, 0.0])
@pytest.mark.parametrize("priority", [0.0, 0.03, 0.2, 1.0])
@pytest.mark.parametrize("apical", [-1.0, 0.0, 0.3, 3.0])
def test_the_shares_are_all_that_was_given_and_none_is_negative(apical: float, priority: float, bound: float) -> None:
    for sides, tip in axes():
        places, amounts = shared(sides, tip, 10, apical, priority, bound)
        assert (places == np.flatnonzero(sides)).all()
        assert len(amounts) == len(places) + 1
        assert (amounts >= 0).all()
        assert amounts.sum() == pytest.approx(10, rel=1e-4)
        assert np.isfinite(amounts).all()


def test_a_bound_on_the_tip_gives_its_surplus_to_the_others_in_proportion() -> None:
    for sides, tip in axes():
        _, free = shared(sides, tip, apical=1.0)
        bound = free[-1] / 2
        _, amounts = shared(sides, tip, apical=1.0, bound=bound)
        if len(amounts) == 1:
            assert amounts == free  # nobody else to give it to
            continue
        assert amounts[-1] == pytest.approx(bound)
        assert amounts[:-1] == pytest.approx(free[:-1] * (10 - bound) / (10 - free[-1]), rel=1e-4)


def test_a_bound_that_the_tip_does_not_reach_changes_nothing() -> None:
    for sides, tip in axes():
        _, free = shared(sides, tip)
        _, amounts = shared(sides, tip, bound=float(free[-1]) * 1.01)
        assert amounts.tobytes() == free.tobytes()


def test_more_apical_control_gives_the_tip_more_and_no_side_at_the_base_more() -> None:
    for sides, tip in axes():
        if not sides.any() or tip < 0.01:
            continue
        found = [shared(sides, tip, apical=apical)[1] for apical in (-1.0, -0.2, 0.0, 0.2, 1.0)]
        assert (np.diff([amounts[-1] for amounts in found]) > 0).all()
        assert (np.diff([amounts[0] for amounts in found]) < 0).all()


def test_without_apical_control_shares_are_those_of_the_light() -> None:
    """Borchert and Honda with lambda = 1/2: lambda / (1 - lambda) = 1 at every joint."""
    for sides, tip in axes():
        places, amounts = shared(sides, tip, apical=0.0)
        total = sides.sum() + tip
        assert amounts == pytest.approx(np.append(sides[places], tip) * 10 / total, rel=1e-3, abs=1e-5)


def test_more_light_brings_a_side_more() -> None:
    for sides, tip in axes():
        for joint in np.flatnonzero(sides)[:5]:
            lit = sides.copy()
            lit[joint] *= 1.5
            places, dim = shared(sides, tip)
            where = list(places).index(joint)
            bright = shared(lit, tip)[1]
            assert bright[where] > dim[where]


def test_priority_concentrates_on_the_largest_and_keeps_their_order() -> None:
    for sides, tip in axes():
        found = [shared(sides, tip, priority=priority)[1] for priority in (0.0, 0.03, 0.1, 0.2)]
        if len(found[0]) < 3:
            continue
        assert (np.diff([amounts.max() for amounts in found]) > 0).all()
        assert (np.diff([np.square(amounts).sum() for amounts in found]) > 0).all()
        order = np.argsort(-found[0], kind="stable")
        for amounts in found:
            assert (np.diff(amounts[order]) <= 1e-6).all()


def test_twice_as_much_is_shared_alike() -> None:
    for sides, tip in axes():
        one, two = (shared(sides, tip, given, 0.3, 0.05)[1] for given in (5, 10))
        assert two == pytest.approx(2 * one, rel=1e-4)
