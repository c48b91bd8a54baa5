"""Years of GEGen: a younger tree is the same one before, and what grew in the same memory leaves no trace."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from generators.gegen import generator
from generators.gegen.scratch import Scratch
from generators.gegen.tree import BORN, X, Z
from tests.generators.grown import BROAD, GENERATOR, grow, random_values
from treefit.plant import check_plant
from treefit.plant.contract import same


def test_the_tree_of_a_year_is_the_beginning_of_that_of_the_next() -> None:
    """Without shedding every joint stays where it is."""
    for values in random_values(8, shedding=0.0):
        for young, old in itertools.pairwise(grow(**{**values, "age": age}) for age in (1, 2, 5, 6, 12, 13, 24)):
            n = young.joint.shape[1]
            assert n <= old.joint.shape[1]
            assert young.joint[X : Z + 1].tobytes() == old.joint[X : Z + 1, :n].tobytes()
            assert (young.node[BORN, 2:] == old.node[BORN, 2:n]).all()  # a seedling's first internode is of any year
            check_plant(young.plant)
            m = young.plant.n_vertices
            assert young.plant.position.tobytes() == old.plant.position[:m].tobytes()
            assert young.plant.parent.tobytes() == old.plant.parent[:m].tobytes()
            assert (young.plant.radius <= old.plant.radius[:m] * (1 + 1e-5)).all()


def test_with_shedding_too_nothing_moves_and_what_is_lost_stays_lost() -> None:
    for values in random_values(8, shedding=0.3):
        trees = [grow(**{**values, "age": age}) for age in (6, 12, 13, 24)]
        for young, old in itertools.pairwise(trees):
            n = young.joint.shape[1]
            assert young.joint[X : Z + 1].tobytes() == old.joint[X : Z + 1, :n].tobytes()
            assert (old.lost[:n] >= young.lost).all()


def test_joints_of_a_year_follow_those_of_the_years_before() -> None:
    for values in random_values(20):
        assert (np.diff(grow(**values).node[BORN]) >= 0).all()


def test_growth_that_has_ended_does_not_begin_again() -> None:
    for values in random_values(8, growth_rate=0.6):
        grown_up, old = (GENERATOR({**values, "age": age}, 1, BROAD) for age in (50, 51))
        assert same(grown_up, old)


def test_what_was_in_memory_before_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """The next tree grows where an earlier one lies, even one that was cut in the middle of a year."""
    for values in random_values(30, 9, shade=1.0) + random_values(30, 9, apical_control=3.0):
        clean = grow(**values)
        room = Scratch()
        room.room(int(1.3 * float(values["internodes"])) + 500)
        joint, node, axis, stem, key = room.tree
        joint[:], axis[:] = 1e3, 1e3
        node[:], stem[:], key[:] = 1, 1, 1
        monkeypatch.setattr(generator, "_SCRATCH", room)
        assert same(GENERATOR(values, 1, BROAD), clean.plant)
