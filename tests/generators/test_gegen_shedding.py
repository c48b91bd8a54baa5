"""Shedding of GEGen: branches that gather little light are lost, and crowns are bare inside and below."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from generators.gegen.light import YOUNG, _given_up
from generators.gegen.tree import AXIS, BASE, DEAD, LEVEL, START, Z
from tests.generators.grown import OPEN, Grown, grow, random_values

STEPS = (0.0, 0.05, 0.1, 0.2, 0.4)


@pytest.fixture(scope="module")
def trees() -> list[list[Grown]]:
    """Random trees, of each one for every step of shedding."""
    many = random_values(20, 3, internodes=4000, shade=0.4, **OPEN)
    return [[grow(**{**values, "shedding": step}) for step in STEPS] for values in many]


def means(trees: list[list[Grown]], measure: object) -> list[float]:
    assert callable(measure)
    return [float(np.mean([measure(row[step]) for row in trees])) for step in range(len(STEPS))]


def test_without_shedding_nothing_is_lost(trees: list[list[Grown]]) -> None:
    for row in trees:
        assert not row[0].lost.any()
        assert row[0].plant.n_vertices == row[0].joint.shape[1]


def test_the_plant_is_what_was_not_lost(trees: list[list[Grown]]) -> None:
    for tree in (tree for row in trees for tree in row):
        assert tree.plant.n_vertices == (~tree.lost).sum()
        np.testing.assert_allclose(tree.plant.position, 0.25 * tree.joint[:3, ~tree.lost].T, rtol=1e-5)


def test_what_grows_on_a_lost_branch_is_lost_and_the_trunk_stays(trees: list[list[Grown]]) -> None:
    for tree in (tree for row in trees for tree in row):
        dead, base = tree.stem[DEAD] > 0, tree.stem[BASE]
        assert not dead[0]
        assert dead[1:][tree.lost[base[1:]]].all()


def test_more_shedding_leaves_less(trees: list[list[Grown]]) -> None:
    assert (np.diff(means(trees, lambda tree: tree.plant.n_vertices)) < 0).all()


def test_more_shedding_leaves_lighter_crowns_that_are_barer_below(trees: list[list[Grown]]) -> None:
    assert (np.diff(means(trees, lambda tree: tree.light[~tree.lost].mean())) > 0).all()
    assert (np.diff(means(trees, height_of_branches)) > 0).all()


def height_of_branches(tree: Grown) -> float:
    """Mean height of joints of branches by that of the tree."""
    live = ~tree.lost
    branches = live & (tree.stem[LEVEL, tree.node[AXIS]] > 0)
    heights = tree.joint[Z, branches] / tree.joint[Z, live].max()
    return float(heights.mean()) if branches.any() else 1.0


def test_a_branch_at_the_threshold_is_lost_every_other_time_and_one_in_twice_the_light_seldom() -> None:
    found = [lost_share(light, 10.0, 0.2) for light in (0.0, 1.0, 2.0, 4.0, 100.0)]
    assert found == pytest.approx([1, 16 / 17, 1 / 2, 1 / 17, 0], abs=0.02)
    assert lost_share(0.0, 10.0, 0.0) == 0


def lost_share(light: float, size: float, shedding: float) -> float:
    """Share of many branches of `size` joints and that much light that are given up."""
    rule = SimpleNamespace(shedding=shedding)
    keys = np.random.default_rng(0).integers(0, 2**32, 4_000, np.uint32)
    with np.errstate(over="ignore"):
        return float(np.mean([_given_up.py_func(rule, np.float32(light), np.float32(size), key) for key in keys]))


def test_young_branches_are_kept() -> None:
    for values in random_values(10, 3, shedding=5.0, shade=1.0):
        for age in (6, 9, 12):
            tree = grow(**{**values, "age": age})
            given_up = (tree.stem[DEAD, 1:] > 0) & ~tree.lost[tree.stem[BASE, 1:]]
            assert (tree.stem[START, 1:][given_up] <= age - YOUNG).all()
