"""The cut of the branch graph into stems: where each begins and what it is made of."""

import numpy as np
import pytest

from tests.asset.bodies import areas, solid, wood
from treefit.asset.mesh import branch_meshes
from treefit.asset.mesh.stems import stems_of
from treefit.plant import Plant


@pytest.mark.parametrize("plain", [True, False])
def test_frames_do_not_twist(tree, plain):
    stems = stems_of(tree, plain)
    turned = (stems.side[1:] * stems.side[:-1]).sum(axis=1)
    bent = (stems.tangent[1:] * stems.tangent[:-1]).sum(axis=1)
    inside = np.setdiff1d(np.arange(len(turned)), stems.first[1:-1] - 1)
    assert (turned[inside] >= bent[inside] - 1e-6).all()


def test_a_branch_begins_at_its_parent_vertex_with_its_own_radius():
    fork = wood(
        [[0, 0, 0], [0, 0, 1], [0, 0, 2], [0.5, 0, 1.5], [0.8, 0, 1.8]],
        [0.2, 0.15, 0.1, 0.06, 0.03], [-1, 0, 1, 1, 3], [0, 0, 0, 1, 1],
    )  # fmt: skip
    stems = stems_of(fork, plain=True)
    start = stems.first[1]
    np.testing.assert_allclose(stems.centre[start], [0, 0, 1])
    np.testing.assert_allclose(stems.radius[start : start + 3], [0.06, 0.06, 0.03], rtol=1e-6)


def test_every_segment_is_covered_once(tree):
    stems = stems_of(tree, plain=True)
    assert len(stems.centre) - len(stems.level) == tree.n_vertices - 1


POLE = ([[0, 0, 0], [0, 0, 1], [0, 0, 2]], [0.2, 0.15, 0.1])


def branched(*stem, radius=0.05, on=1, pole=POLE):
    """Return a pole of three vertices with one stem of level 1 at vertex `on`."""
    places, radii = pole
    n = len(places)
    return wood(
        [*places, *stem], [*radii, *np.linspace(radius, radius / 2, len(stem))],
        [*range(-1, n - 1), on, *range(n, n + len(stem) - 1)], [0] * n + [1] * len(stem),
    )  # fmt: skip


def branch_rings(plant):
    stems = stems_of(plant, plain=True)
    return [rings for rings, level in zip(np.split(stems.centre, stems.first[1:-1]), stems.level, strict=True) if level]


def seated(plant: Plant) -> tuple[Plant, list[int]]:
    """Return `plant` with its side stems moved to vertices of their own between two of their parent, and these."""
    rng = np.random.default_rng(3)
    parent, level = plant.parent.tolist(), plant.level.tolist()
    goes_on = {p: i for i, p in reversed(list(enumerate(parent))) if i and level[i] == level[p]}
    moved, index, seats = {-1: np.zeros(3, np.float32)}, {-1: -1}, []
    rows: list[tuple] = []
    for i, p in enumerate(parent):
        moved[i], index[i] = moved[p], index[p]
        if i and level[i] > level[p] and p in goes_on:
            moved[i] = moved[p] + np.float32(rng.uniform()) * (plant.position[goes_on[p]] - plant.position[p])
            seats.append(len(rows))
            rows.append((plant.position[p] + moved[i], plant.radius[i], index[p], level[i]))
            index[i] = seats[-1]
        rows.append((plant.position[i] + moved[i], plant.radius[i], index[i], level[i]))
        index[i] = len(rows) - 1
    return wood(*zip(*rows, strict=True)), seats


def test_a_stem_that_is_seated_between_two_vertices_begins_at_its_seat():
    rings = branch_rings(branched([0, 0, 1.3], [0.5, 0, 1.6], [1, 0, 1.8]))
    np.testing.assert_allclose(rings, [[[0, 0, 1.3], [0.5, 0, 1.6], [1, 0, 1.8]]], rtol=1e-6)


def test_a_seated_stem_of_one_segment_is_drawn_and_a_seat_alone_is_not():
    assert [len(rings) for rings in branch_rings(branched([0, 0, 1.3], [0.5, 0, 1.6]))] == [2]
    assert branch_rings(branched([0, 0, 1.3])) == []


@pytest.mark.parametrize("height", [1.0, 2.0])
def test_a_seat_on_a_vertex_of_the_parent_is_one_ring(height):
    rings = branch_rings(branched([0, 0, height], [0.5, 0, 2.5]))
    np.testing.assert_allclose(rings, [[[0, 0, height], [0.5, 0, 2.5]]])


def test_a_seat_on_the_last_vertex_of_the_parent_is_one_ring():
    rings = branch_rings(branched([0, 0, 2], [0, 0, 3], on=2))
    np.testing.assert_allclose(rings, [[[0, 0, 2], [0, 0, 3]]])


def test_a_stem_that_goes_on_beyond_its_parents_tip_begins_at_that_tip():
    rings = branch_rings(branched([0, 0, 2.5], [0, 0, 3], on=2))
    np.testing.assert_allclose(rings, [[[0, 0, 2], [0, 0, 2.5], [0, 0, 3]]])


def test_a_stem_that_leaves_at_an_angle_begins_at_its_parents_vertex():
    rings = branch_rings(branched([0.01, 0, 1.3], [0.5, 0, 1.6]))
    np.testing.assert_allclose(rings[0][0], [0, 0, 1])


def test_a_stem_may_be_seated_on_a_clone_of_its_parent():
    fork = wood(
        [[0, 0, 0], [0, 0, 1], [0, 0, 2], [1, 0, 2], [0.5, 0, 1.5], [0.5, 1, 1.5]],
        [0.2, 0.1, 0.05, 0.05, 0.02, 0.01], [-1, 0, 1, 1, 1, 4], [0, 0, 0, 0, 1, 1],
    )  # fmt: skip
    np.testing.assert_allclose(branch_rings(fork), [[[0.5, 0, 1.5], [0.5, 1, 1.5]]])


def test_a_clone_begins_at_the_vertex_where_it_parts_even_when_that_is_a_seat():
    clone = wood(
        [[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 1.5], [1, 0, 1.5], [1, 1, 1.5]],
        [0.2, 0.1, 0.05, 0.04, 0.03, 0.02], [-1, 0, 1, 1, 3, 3], [0, 0, 0, 1, 1, 1],
    )  # fmt: skip
    rings = branch_rings(clone)
    np.testing.assert_allclose(rings, [[[0, 0, 1.5], [1, 0, 1.5]], [[0, 0, 1.5], [1, 1, 1.5]]])


def test_seated_stems_have_their_own_radius_and_no_ring_in_the_parents_wood(tree):
    plant, seats = seated(tree)
    stems = stems_of(plant, plain=True)
    begins = {tuple(stems.centre[ring]): stems.radius[ring] for ring in stems.first[:-1]}
    assert [begins.get(tuple(plant.position[seat])) for seat in seats] == plant.radius[seats].tolist()
    assert len(stems.centre) - len(stems.level) == plant.n_vertices - 1 - len(seats)


def test_seated_stems_are_closed_bodies(tree):
    for mesh in branch_meshes(seated(tree)[0]).values():
        body = solid(mesh)
        assert body.is_volume
        assert body.volume > 0
        assert areas(mesh).min() > 0
