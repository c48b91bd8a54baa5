"""Wood for a count of triangles."""

import numpy as np
import pytest

from tests.asset.bodies import wood
from tests.asset.conftest import make_tree
from treefit.asset.lod.cones import cones
from treefit.asset.lod.stem_tree import stem_tree
from treefit.asset.lod.thin_wood import thin_wood
from treefit.asset.mesh.skin import skin_of
from treefit.asset.mesh.stems import stems_of


@pytest.fixture(scope="module")
def tree():
    return stem_tree(stems_of(make_tree(branches=18, twigs=6, leaves=0)), 7)


@pytest.mark.parametrize("budget", [200, 1000, 3000])
def test_the_budget_is_kept_and_used(tree, budget):
    thin = thin_wood(tree, np.ones(len(tree.stems.radius)), budget)
    mesh = cones(thin, tree.stems, skin_of(tree.stems))
    assert len(mesh.faces) == thin.triangles
    assert 0.9 * budget <= thin.triangles <= budget


def test_no_stem_stands_in_the_air(tree):
    thin = thin_wood(tree, np.ones(len(tree.stems.radius)), 800)
    first, last = thin.first[:-1], thin.first[1:] - 1
    is_last = np.zeros(len(thin.ring), bool)
    is_last[last] = True
    begin, end = thin.centre[np.flatnonzero(~is_last)], thin.centre[np.flatnonzero(~is_last) + 1]
    stem = np.repeat(np.arange(len(first)), np.diff(thin.first))[~is_last]
    for s, base in enumerate(thin.centre[first]):
        if thin.level[s] == 0:
            continue
        a, step = begin[stem != s], (end - begin)[stem != s]
        part = np.clip(np.einsum("ij,ij->i", base - a, step) / np.einsum("ij,ij->i", step, step), 0, 1)
        assert np.linalg.norm(a + part[:, None] * step - base, axis=1).min() < 1e-6


def test_what_is_hidden_goes_first(tree):
    seen = np.where(tree.stems.centre[:, 0] > 0, 1.0, 0.05)
    thin = thin_wood(tree, seen, 800)
    right = tree.stems.centre[thin.ring, 0] > 0
    assert right.mean() > 0.7


def test_a_straight_stem_needs_two_rings_and_a_bent_one_keeps_its_bend():
    straight = wood([[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 3]], [0.3, 0.2, 0.1, 0.01], [-1, 0, 1, 2], [0] * 4)
    bent = wood([[0, 0, 0], [0, 0, 1], [1, 0, 2], [1, 0, 3]], [0.3, 0.2, 0.1, 0.01], [-1, 0, 1, 2], [0] * 4)
    rings = []
    for plant in (straight, bent):
        stems = stems_of(plant, plain=True)
        rings.append(len(thin_wood(stem_tree(stems, 7), np.ones(4), 26).ring))
    assert rings[0] == 2 < rings[1]


def test_outlines_are_as_wide_with_fewer_corners():
    stems = stems_of(wood([[0, 0, 0], [0, 0, 1], [0, 0, 2]], [0.3, 0.2, 0.1], [-1, 0, 1], [0] * 3), plain=True)
    tree = stem_tree(stems, 16)
    widths = []
    for budget in (6, 10**4):
        thin = thin_wood(tree, np.ones(3), budget)
        place = cones(thin, stems, skin_of(stems)).vertices
        foot = place[place[:, 2] < 1e-6][:, :2]
        angle = np.linspace(0, np.pi, 64, endpoint=False)
        reach = foot @ np.stack([np.cos(angle), np.sin(angle)])
        widths.append(np.ptp(reach, axis=0).mean())
    assert widths[0] == pytest.approx(widths[1], rel=0.35)
