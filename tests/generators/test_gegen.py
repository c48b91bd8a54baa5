"""GEGen: the growth equation, what it allows every axis, and where joints are."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from numba import njit
from numpy.typing import NDArray

from generators.gegen.obstacles import GROUND
from generators.gegen.rules import rule_of
from generators.gegen.tree import (
    AGED,
    AXIS,
    BASE,
    BORN,
    DEAD,
    DX,
    DY,
    DZ,
    HEAD,
    LEVEL,
    ORDER,
    PARENT,
    PATH,
    START,
    TIP,
    X,
    Z,
)  # fmt: skip
from generators.gegen.year import leader_at
from tests.generators.grown import GENERATOR, OPEN, Grown, grow, random_values
from treefit.plant import Value

STRAIGHT: dict[str, Value] = {
    "light_seeking": 0.0, "tropism": 0.0, "tropism_change": 0.0, "wobble": 0.0, "straightness": 0.0, "lean": 0.0,
    "bend": 0.0,
}  # fmt: skip
"""Axes keep the way in which they set out."""


@pytest.fixture(scope="module")
def trees() -> list[tuple[dict[str, Value], Grown]]:
    """Random trees with their values."""
    return [(values, grow(**values)) for values in random_values(60)]


@njit
def _leader(rule, years):
    return np.array([leader_at(rule, year) for year in years])


def leader(values: dict[str, Value], years: int) -> NDArray[np.float64]:
    """Height of the leader in internodes, of the years from 0 on."""
    found: NDArray[np.float64] = _leader(rule_of(values, (0.0, 0.0), False), np.arange(years + 1))
    return found


def test_the_growth_equation_is_logistic_from_the_start_to_the_leader() -> None:
    for values in random_values(30):
        length = leader(values, 200)
        least, most = float(values["start"]), float(values["leader"])
        assert length[0] == pytest.approx(least)
        assert length[-1] == pytest.approx(most, rel=1e-3)
        assert (np.diff(length[:20]) > 0).all()
        odds = np.log(length[:20] / (most - length[:20]))
        assert np.diff(odds) == pytest.approx(float(values["growth_rate"]), rel=1e-3)


def test_no_axis_grows_more_in_a_year_than_the_growth_equation_allows(
    trees: list[tuple[dict[str, Value], Grown]],
) -> None:
    slow = [(values, grow(**values)) for values in random_values(20, 1, branch_growth=0.3)]
    for values, tree in [*trees, *slow]:
        bounds = np.diff(leader(values, int(values["age"])))
        born, axis = tree.node[BORN, 1:], tree.node[AXIS, 1:]
        shoots = np.zeros((axis.max() + 1, int(values["age"]) + 1), int)
        np.add.at(shoots, (axis, born), 1)
        assert (shoots[0, 1:] <= np.ceil(bounds + 1e-6)).all()
        assert (shoots[1:, 1:] <= np.ceil(bounds * float(values["branch_growth"]) + 1e-6)).all()


def test_a_tree_grows_about_as_many_internodes_as_it_is_given_at_most(
    trees: list[tuple[dict[str, Value], Grown]],
) -> None:
    for values, tree in trees:
        assert tree.joint.shape[1] <= 1.3 * float(values["internodes"])
    assert max(tree.joint.shape[1] / float(values["internodes"]) for values, tree in trees) > 0.6


def test_internodes_is_what_is_grown_near_the_defaults() -> None:
    """Far from them light or the growth equation may feed less: no genome is given more."""
    alone: dict[str, Value] = {**OPEN, "shedding": 0.0}
    for internodes in (700, 1500, 3000, 8000):
        assert grow(**alone, internodes=internodes).plant.n_vertices == pytest.approx(internodes, rel=0.12)
    near, wide = (grown_shares(width, alone) for width in (0.1, 0.25))
    assert (np.abs(near - 1) <= 0.15).mean() >= 0.95
    assert (np.abs(wide - 1) <= 0.25).mean() >= 0.75
    assert wide.max() < 1.05


def grown_shares(width: float, values: dict[str, Value], count: int = 100) -> NDArray[np.float64]:
    """Vertices by `internodes` of genomes up to `width` from that of the defaults, some values as told (count,)."""
    space = GENERATOR.space
    genomes = space.encode(space.complete({})) + np.random.default_rng(0).uniform(-width, width, (count, len(space)))
    told = [{**space.decode(np.clip(genome, 0, 1)), **values} for genome in genomes]
    return np.array([grow(**each).plant.n_vertices / float(each["internodes"]) for each in told])


def test_every_internode_is_as_long_as_it_should_be(trees: list[tuple[dict[str, Value], Grown]]) -> None:
    for values, tree in trees:
        position, parent = tree.plant.position.astype(np.float64), tree.plant.parent
        lengths = np.linalg.norm(position[1:] - position[parent[1:]], axis=1)
        assert lengths == pytest.approx(float(values["internode"]), rel=1e-3)


def test_nothing_is_below_the_ground(trees: list[tuple[dict[str, Value], Grown]]) -> None:
    low = [{"tropism": -0.5, "angle": 150, "angle_top": 150, "trunk": 0, "bend": 170}, {"tropism": -5, "lean": 70}]
    for tree in (*(tree for _, tree in trees), *(grow(**values) for values in low)):
        plant = tree.plant
        assert (tree.joint[Z, 1:] > 0.19).all()
        assert (plant.leaf_position[:, 2] >= 0).all()
        tips = plant.leaf_position + plant.leaf_axis * plant.leaf_size[:, :1]
        assert (tips[:, 2] >= -1e-3 * plant.leaf_size[:, 0]).all()


def test_branches_stop_at_the_ground_and_grow_no_more() -> None:
    seen = 0
    for values in random_values(12, trunk=0.05, tropism_change=-2.0, shedding=0.0):
        young, old = (grow(**{**values, "age": age}) for age in (12, 24))
        for tree in (young, old):
            stopped = tree.stem[AGED] > 0
            assert (tree.joint[Z, tree.stem[TIP, stopped]] < 1 + GROUND).all()
            assert (tree.joint[Z, 1:] > GROUND - 1e-4).all()
            assert (tree.stem[DEAD, stopped] == (tree.stem[HEAD, stopped] < 0)).all()  # what never began is no branch
        stopped = np.flatnonzero(young.stem[AGED])
        assert (old.stem[:, stopped] == young.stem[:, stopped]).all()
        seen += len(stopped)
    assert seen > 50


def test_joints_know_their_parents_places_and_years(trees: list[tuple[dict[str, Value], Grown]]) -> None:
    for _, tree in trees:
        node, stem = tree.node[:, 1:], tree.stem
        parent, axis = node[PARENT], node[AXIS]
        first = parent == stem[BASE, axis]
        first[0] = True  # the trunk begins with the root
        assert (parent < np.arange(1, len(parent) + 1)).all()
        assert (node[BORN] >= tree.node[BORN, parent]).all()
        assert (tree.node[AXIS, parent][~first] == axis[~first]).all()
        assert (node[ORDER][~first] == tree.node[ORDER, parent][~first] + 1).all()
        assert (stem[LEVEL, axis[first]][1:] == stem[LEVEL, tree.node[AXIS, parent[first]]][1:] + 1).all()
        assert (node[PATH][stem[LEVEL, axis] == 0] == 0).all()


def test_levels_are_as_many_as_told(trees: list[tuple[dict[str, Value], Grown]]) -> None:
    for values, tree in trees:
        assert tree.plant.level.max() <= int(values["levels"]) - 1
    for levels in range(1, 6):
        assert grow(levels=levels, shedding=0.0).plant.level.max() == levels - 1


@pytest.mark.parametrize("share", [0.0, 0.15, 0.3, 0.5])
def test_no_branch_begins_on_the_bare_trunk(share: float) -> None:
    for values in random_values(12, trunk=share, shedding=0.0):
        tree = grow(**values)
        orders = tree.node[ORDER, tree.stem[BASE, tree.stem[LEVEL] == 1]]
        assert (orders >= round(share * int(values["leader"]))).all()
        assert (tree.joint[Z, 1:][tree.stem[LEVEL, tree.node[AXIS, 1:]] == 0] > 0).all()


def test_branches_set_out_at_their_angle() -> None:
    seen = 0
    for values in random_values(20, forks=0, angle_variation=7.0, **STRAIGHT):
        tree = grow(**values)
        orders, levels, angles = setting_out(tree)
        low, high = float(values["angle"]), float(values["angle_top"])
        along = np.clip(orders / float(values["leader"]), 0, 1)
        wished = np.where(levels == 1, low + (high - low) * along, float(values["angle_branches"]))
        assert (np.abs(angles - wished) <= 7.2).all()
        seen += len(angles)
    assert seen > 500


@pytest.mark.parametrize(("share", "joints"), [(0.25, 9), (0.0, 1)])
def test_forks_begin_together_at_the_top_of_the_bare_trunk_which_has_a_joint(share: float, joints: int) -> None:
    tree = grow(forks=4, trunk=share, leader=36, fork_angle=35, angle_variation=0.0, shedding=0.0, **STRAIGHT)
    orders, levels, angles = setting_out(tree)
    first = (levels == 1) & (orders == joints)
    assert first.sum() == 4
    assert angles[first] == pytest.approx(35, abs=0.2)
    assert orders[levels == 1].min() == joints
    assert len(set(tree.stem[START, 1:][tree.stem[HEAD, 1:] >= 0][first])) == 1


def setting_out(tree: Grown) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]]:
    """Of every axis but the trunk: place of its base on the parent's axis, level, degrees between the two there."""
    stem = tree.stem[:, 1:][:, tree.stem[HEAD, 1:] >= 0]
    base, head = stem[BASE], stem[HEAD]
    one, two = (tree.joint[[DX, DY, DZ]][:, joints].astype(np.float64) for joints in (base, head))
    cosine = (one * two).sum(axis=0) / np.linalg.norm(one, axis=0) / np.linalg.norm(two, axis=0)
    return tree.node[ORDER, base], stem[LEVEL], np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def test_the_lean_and_the_bend_are_those_of_the_bare_trunk() -> None:
    for lean, bend in itertools.product((-10, 0, 12), (-25, 0, 20)):
        tree = grow(lean=lean, bend=bend, trunk=0.4, leader=40)
        trunk = tree.node[AXIS] == 0
        dx, dz, order = tree.joint[DX, trunk], tree.joint[DZ, trunk], tree.node[ORDER, trunk]
        angle = np.degrees(np.arctan2(dx, dz))[(order > 0) & (order <= 16)]
        assert angle == pytest.approx(lean + bend * np.arange(1, 17) / 16, abs=0.1)
        assert not tree.joint[DY, trunk][order <= 16].any()


def test_a_straight_tree_without_branches_is_as_high_as_the_leader() -> None:
    tree = grow(levels=1, age=60, leader=30, start=2.0, **STRAIGHT)
    assert tree.joint[X].max() == pytest.approx(0, abs=1e-3)
    assert math.isclose(float(tree.joint[Z].max()), 30, abs_tol=3)
