"""The rings that make stems smooth, and where stems begin on the curves of others."""

from __future__ import annotations

import numpy as np
import pytest

from generators.gegen import GEGen
from generators.weberpenn import WeberPennGen
from tests.asset.bodies import wood
from tests.asset.conftest import make_tree
from treefit.plant import Budget, Plant
from treefit.plant.bends import PIECES
from treefit.plant.chains import chains_of
from treefit.plant.curves import Curves, curves_of, plain_curves
from treefit.plant.flare import RINGS


def species() -> list[Plant]:
    plants = [make_tree(leaves=10)]
    for generator, name in ((WeberPennGen(), "quaking_aspen"), (GEGen(), "oak")):
        preset = generator.presets[name]
        plants.append(generator(generator.space.complete(preset.values), preset.seed, Budget(3000, 10)))
    return plants


PLANTS = species()


def rings(curves: Curves, stem: int) -> slice:
    return slice(curves.first[stem], curves.first[stem + 1])


def arc(turn: float, count: int, radius: float = 0.01) -> Plant:
    """Return a pole with a stem of level 1 that is an arc of radius 1 m, of `turn` rad in `count` segments."""
    angle = np.linspace(0, turn, count + 1)
    stem = np.column_stack([np.sin(angle), 0 * angle, 2 - np.cos(angle)])[1:]
    thick = [0.1, 0.1, 0.1, *[radius] * count]
    return wood(
        [[0, 0, 0], [0, 0, 1], [0, 0, 2], *stem], thick, [-1, 0, 1, 1, *range(3, 2 + count)], [0] * 3 + [1] * count
    )


def test_a_straight_thin_stem_has_the_rings_of_its_chain_and_the_trunk_a_foot() -> None:
    places = [[0, 0, 0], [0, 0, 1], [0, 0, 4], [0.5, 0, 1], [2, 0, 1]]
    curves = curves_of(chains_of(wood(places, [0.1, 0.1, 0.1, 0.001, 0.001], [-1, 0, 1, 1, 3], [0, 0, 0, 1, 1])))
    np.testing.assert_allclose(curves.centre[rings(curves, 1)], [[0, 0, 1], [0.5, 0, 1], [2, 0, 1]])
    foot = curves.centre[rings(curves, 0)]
    assert foot[0, 2] < 0 == foot[1, 2]
    assert len(foot) == 3 + 1 + len(RINGS)
    assert (np.diff(curves.radius[rings(curves, 0)]) <= 0).all()


@pytest.mark.parametrize("plant", PLANTS)
def test_stems_run_through_the_rings_of_their_chains(plant: Plant) -> None:
    chains = chains_of(plant)
    curves = curves_of(chains)
    whole = curves.at == np.floor(curves.at)
    inside = whole & ~np.isin(np.arange(len(whole)), curves.first[:-1])
    np.testing.assert_allclose(curves.centre[inside], chains.centre[curves.at[inside].astype(int)], atol=1e-12)
    assert (np.diff(curves.first) >= np.diff(chains.first)).all()
    assert (np.diff(curves.at)[np.diff(np.repeat(np.arange(len(curves)), np.diff(curves.first))) == 0] >= 0).all()


@pytest.mark.parametrize("count", [2, 3, 4])
def test_a_bend_is_shown_by_few_pieces_nearer_to_it_than_its_chords(count: int) -> None:
    curves = curves_of(chains_of(arc(1.2, count, 0.0001)))
    stem = curves.centre[rings(curves, 1)][1:]
    far = np.abs(np.linalg.norm(stem - [0, 0, 2], axis=1) - 1)
    assert far.max() < 0.5 * (1 - np.cos(0.6 / count))
    assert count < len(stem) <= PIECES * count


@pytest.mark.parametrize("plant", PLANTS)
def test_stems_begin_on_the_wood_that_carries_them(plant: Plant) -> None:
    curves = curves_of(chains_of(plant))
    hosted = curves.host >= 0
    assert hosted[1:].all()
    host, share = curves.host[hosted], curves.share[hosted, None]
    onward = np.minimum(host + 1, len(curves.centre) - 1)
    axis = curves.centre[host] * (1 - share) + curves.centre[onward] * share
    np.testing.assert_allclose(curves.centre[curves.first[:-1][hosted]], axis, atol=1e-9)
    assert (host < curves.first[:-1][hosted]).all()


def test_a_split_begins_in_the_direction_of_its_parent() -> None:
    fork = wood([[0, 0, 0], [0, 0, 1], [-0.4, 0, 2], [0.5, 0, 1.5]], [0.1] * 4, [-1, 0, 1, 1], [0] * 4)
    curves = curves_of(chains_of(fork))
    assert curves.guided.tolist() == [False, True]
    branch = curves.centre[rings(curves, 1)]
    step = branch[1] - branch[0]
    assert step[2] / np.linalg.norm(step) > 0.85  # the chord to its end has 0.7


def test_a_trunk_that_widens_by_itself_is_widened_less() -> None:
    def widening(foot: float) -> float:
        pole = wood([[0, 0, 0], [0, 0, 0.5], [0, 0, 5]], [foot, 0.2, 0.1], [-1, 0, 1], [0] * 3)
        return float(curves_of(chains_of(pole)).radius[1] / foot)

    assert 1 < widening(0.3) < widening(0.21) <= 1.5


def test_plain_curves_are_the_chains() -> None:
    chains = chains_of(PLANTS[0])
    plain = plain_curves(chains)
    assert plain.centre is chains.centre
    assert not plain.guided.any()


@pytest.mark.parametrize("plant", PLANTS)
def test_the_same_plant_has_the_same_curves(plant: Plant) -> None:
    one, other = curves_of(chains_of(plant)), curves_of(chains_of(plant))
    assert one.centre.tobytes() == other.centre.tobytes()
    assert one.radius.tobytes() == other.radius.tobytes()
