import dataclasses

import numpy as np
import pytest

from tests.asset.bodies import areas, solid, wood
from treefit.asset.mesh import branch_meshes, leaf_mesh
from treefit.asset.mesh.stems import stems_of
from treefit.plant import LEAF_SHAPES


@pytest.mark.parametrize("plain", [True, False])
def test_trunk_and_branches_are_closed_bodies_with_outward_faces(tree, plain):
    for mesh in branch_meshes(tree, plain=plain).values():
        body = solid(mesh)
        assert body.is_volume
        assert body.volume > 0


def test_a_straight_pole_has_the_volume_of_its_prism():
    pole = wood([[0, 0, 0], [0, 0, 1], [0, 0, 3]], [0.5, 0.5, 0.5], [-1, 0, 1], [0, 0, 0])
    prism = 3 * 0.5 * 32 * 0.5**2 * np.sin(2 * np.pi / 32)
    tip = 0.25 / 3 * prism / 3  # a pyramid half a radius high
    assert solid(branch_meshes(pole, 32, plain=True)["trunk"]).volume == pytest.approx(prism + tip, rel=1e-5)


def test_no_triangle_is_degenerate_and_all_normals_are_unit(tree):
    for mesh in (*branch_meshes(tree).values(), leaf_mesh(tree)):
        assert areas(mesh).min() > 1e-9
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-5)


def test_normals_of_the_walls_point_outwards(tree):
    mesh = branch_meshes(tree)["trunk"]
    stems = stems_of(tree)
    axis = stems.centre[stems.first[0] : stems.first[1]]
    nearest = axis[np.argmin(((mesh.vertices[:, None] - axis) ** 2).sum(axis=2), axis=1)]
    assert (((mesh.vertices - nearest) * mesh.normals).sum(axis=1) > 0).all()


def test_a_fork_of_one_level_tapers_from_its_parents_radius():
    fork = wood([[0, 0, 0], [0, 0, 1], [0, 0, 2], [1, 0, 2]], [0.2, 0.1, 0.05, 0.05], [-1, 0, 1, 1], [0] * 4)
    stems = stems_of(fork, plain=True)
    assert len(stems.level) == 2
    np.testing.assert_allclose(stems.radius[stems.first[1] :], [0.1, 0.05], rtol=1e-6)
    assert set(branch_meshes(fork)) == {"trunk"}


def test_points_that_coincide_and_radii_of_zero_are_harmless():
    pole = wood([[0, 0, 0], [0, 0, 1], [0, 0, 1], [0, 0, 2]], [0.1, 0.1, 0.1, 0], [-1, 0, 1, 2], [0] * 4)
    mesh = branch_meshes(pole)["trunk"]
    assert solid(mesh).is_volume
    assert areas(mesh).min() > 0


def test_thin_stems_have_fewer_sides(tree):
    few, many = branch_meshes(tree, 3, plain=True), branch_meshes(tree, 12, plain=True)
    assert len(few["branches"].faces) < len(many["branches"].faces)
    per_segment = len(many["branches"].faces) / (tree.level > 0).sum()
    assert per_segment < 2 * 12


@pytest.mark.parametrize("fold", [0, 25])
@pytest.mark.parametrize("shape", LEAF_SHAPES)
def test_every_leaf_has_the_area_of_its_ellipse(tree, shape, fold):
    mesh = leaf_mesh(tree, shape, fold)
    per_leaf = areas(mesh).reshape(tree.n_leaves, -1).sum(axis=1)
    np.testing.assert_allclose(per_leaf, np.pi / 4 * tree.leaf_size.astype(float).prod(axis=1), rtol=1e-3)


def test_leaves_reach_from_their_seat_to_their_tip_and_face_their_normal(tree):
    mesh = leaf_mesh(tree)
    corners = mesh.vertices.reshape(tree.n_leaves, -1, 3)
    tip = tree.leaf_position + tree.leaf_axis * tree.leaf_size[:, :1]
    np.testing.assert_allclose(corners[:, 0], tree.leaf_position, atol=1e-5)
    np.testing.assert_allclose(corners[:, 1], tip, atol=1e-5)
    a, b, c = mesh.vertices[mesh.faces].transpose(1, 0, 2)
    per_leaf = np.repeat(tree.leaf_normal, len(mesh.faces) // tree.n_leaves, axis=0)
    assert ((np.cross(b - a, c - a) * per_leaf).sum(axis=1) > 0).all()


def test_too_few_sides_are_refused(tree):
    with pytest.raises(ValueError, match="sides must be 3 or more, got 2"):
        branch_meshes(tree, 2)


def test_an_unknown_outline_is_refused(tree):
    with pytest.raises(ValueError, match=r"one of broad, round, .*, oak_sprig, got 'elm'"):
        leaf_mesh(tree, "elm")


def test_views_of_transposed_arrays_give_the_same_mesh(tree):
    rows = dataclasses.replace(tree, position=np.ascontiguousarray(tree.position.T).T)
    np.testing.assert_array_equal(branch_meshes(rows)["trunk"].vertices, branch_meshes(tree)["trunk"].vertices)
