"""Tangents of squares whose texture lies in known ways."""

import dataclasses

import numpy as np
import pytest

from tests.asset.formats.conftest import square
from treefit.asset.formats.tangents import tangents
from treefit.asset.mesh import Mesh, branch_meshes, leaf_mesh


def bitangents(mesh: Mesh) -> np.ndarray:
    tangent = tangents(mesh)
    return np.cross(mesh.normals, tangent[:, :3]) * tangent[:, 3:]


@pytest.mark.parametrize("scale", [1.0, 7.0])
def test_the_tangent_points_to_the_right_of_the_texture_and_the_bitangent_up(scale):
    np.testing.assert_allclose(tangents(square(scale)), np.tile([1, 0, 0, 1], (4, 1)), atol=1e-6)
    np.testing.assert_allclose(bitangents(square(scale)), np.tile([0, 0, 1], (4, 1)), atol=1e-6)


def test_a_mirrored_texture_has_the_other_sign():
    mirrored = dataclasses.replace(square(), uv=square().uv * [-1, 1])
    np.testing.assert_allclose(tangents(mirrored), np.tile([-1, 0, 0, -1], (4, 1)), atol=1e-6)
    np.testing.assert_allclose(bitangents(mirrored), np.tile([0, 0, 1], (4, 1)), atol=1e-6)


def test_normals_that_look_to_the_back_keep_the_bitangent_up():
    turned = dataclasses.replace(square(), normals=-square().normals)
    np.testing.assert_allclose(bitangents(turned), np.tile([0, 0, 1], (4, 1)), atol=1e-6)


def test_without_a_direction_of_the_texture_there_is_a_tangent_still():
    flat = dataclasses.replace(square(), uv=0 * square().uv)
    np.testing.assert_allclose(np.linalg.norm(tangents(flat)[:, :3], axis=1), 1, atol=1e-6)


def test_tangents_of_a_tree_are_unit_and_at_right_angles_to_its_normals(tree):
    for mesh in (*branch_meshes(tree, 5).values(), leaf_mesh(tree, "broad", 18)):
        found = tangents(mesh)
        np.testing.assert_allclose(np.linalg.norm(found[:, :3], axis=1), 1, atol=1e-5)
        np.testing.assert_allclose(np.einsum("ij,ij->i", found[:, :3], mesh.normals), 0, atol=1e-4)
        assert set(np.unique(found[:, 3])) <= {-1, 1}
