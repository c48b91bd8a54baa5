"""Wood of GEGen: the pipe model at every joint, with the memory of what was shed."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.generators.grown import grow, random_values
from treefit.plant import Plant


def pipes(plant: Plant, power: float, tip: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Of every vertex that bears others: pipes that run through it, and through those it bears together."""
    own = (plant.radius.astype(np.float64) / tip) ** power
    borne = np.zeros_like(own)
    np.add.at(borne, plant.parent[1:], own[1:])
    bears = borne > 0
    return own[bears], borne[bears]


def test_pipes_of_a_joint_are_those_of_what_it_bears() -> None:
    for values in random_values(30, shed_memory=0.0):
        tip = float(values["tip_radius"]) * float(values["internode"])
        own, borne = pipes(grow(**values).plant, float(values["pipe"]), tip)
        assert own == pytest.approx(borne, rel=1e-3)


def test_parents_keep_wood_of_lost_branches() -> None:
    seen = 0
    for values in random_values(30, shed_memory=0.7, shedding=0.3):
        tip = float(values["tip_radius"]) * float(values["internode"])
        tree = grow(**values)
        own, borne = pipes(tree.plant, float(values["pipe"]), tip)
        assert (own >= borne * (1 - 1e-3)).all()
        assert (own > borne * (1 + 1e-2)).any() == tree.lost.any()
        seen += int(tree.lost.any())
    assert seen > 10


def test_the_foot_is_as_thick_as_all_tips_and_the_lost_ones_kept() -> None:
    for values in random_values(20, shed_memory=1.0, shedding=0.2):
        tree = grow(**values)
        tips = tree.node.shape[1] - len(np.unique(tree.node[0, 1:]))
        tip = float(values["tip_radius"]) * float(values["internode"])
        assert (tree.plant.radius[0] / tip) ** float(values["pipe"]) == pytest.approx(tips, rel=1e-2)


def test_a_tip_is_one_pipe_and_no_branch_is_thicker_than_what_bears_it() -> None:
    for values in random_values(20):
        plant = grow(**values).plant
        assert (plant.radius[1:] <= plant.radius[plant.parent[1:]] * (1 + 1e-5)).all()
        tip = float(values["tip_radius"]) * float(values["internode"])
        assert plant.radius.min() == pytest.approx(tip, rel=1e-4)
