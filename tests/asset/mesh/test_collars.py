"""Branches that grow out of their parents."""

import numpy as np
import pytest

from tests.asset.bodies import areas, solid, wood
from treefit.asset.mesh import branch_meshes, stems_of


def joined(angle, radius=0.06):
    """Return a pole of radius 0.2 m with a branch 1.5 m above the ground, at `angle` degrees to it."""
    x, z = np.sin(np.radians(angle)), np.cos(np.radians(angle))
    return wood(
        [[0, 0, 0], [0, 0, 1.5], [0, 0, 3], [x, 0, 1.5 + z], [2 * x, 0, 1.5 + 2 * z]],
        [0.2, 0.2, 0.2, radius, radius], [-1, 0, 1, 1, 3], [0, 0, 0, 1, 1],
    )  # fmt: skip


@pytest.mark.parametrize("angle", [40, 90, 130])
def test_the_first_ring_of_a_thick_branch_hugs_its_parent(angle):
    plant = joined(angle)
    stems, mesh = stems_of(plant), branch_meshes(plant, 24)["branches"]
    assert stems.collar[stems.first[1]] == 0
    corners = len(mesh.vertices) // (stems.first[2] - stems.first[1])
    far = np.hypot(*mesh.vertices[:corners, :2].T)
    assert far.max() < 0.2
    assert far.min() > 0.2 - 0.06
    out = mesh.vertices[:corners] * [1, 1, 0] / far[:, None]
    assert (out * mesh.normals[:corners]).sum(axis=1).min() > 0.9


@pytest.mark.parametrize("angle", [30, 60, 90, 120, 150])
@pytest.mark.parametrize("radius", [0.02, 0.1, 0.18])
def test_a_branch_with_a_collar_is_a_closed_body_that_begins_in_its_parent(angle, radius):
    mesh = branch_meshes(joined(angle, radius), 12)["branches"]
    assert solid(mesh).is_volume
    assert solid(mesh).volume > 0
    assert areas(mesh).min() > 0
    a, b, c = mesh.vertices[mesh.faces].astype(float).transpose(1, 0, 2)
    flat = np.cross(b - a, c - a)
    shown = (np.hypot(*((a + b + c) / 3)[:, :2].T) > 0.21) & (areas(mesh) > 1e-7)
    own = mesh.normals[mesh.faces].mean(axis=1)
    assert ((flat * own).sum(axis=1)[shown] > 0).all()  # no face is turned over


@pytest.mark.parametrize(("angle", "radius"), [(10, 0.06), (90, 0.19), (90, 0.0005)])
def test_flat_wide_and_thin_stems_have_no_collar(angle, radius):
    stems = stems_of(joined(angle, radius))
    assert (stems.collar < 0).all()


def test_bark_has_no_seam_and_is_not_stretched(tree):
    assert branch_meshes(tree)["trunk"].uv[:, 0].max() == 1
    mesh = branch_meshes(joined(60), 16)["trunk"]
    u, v, w = mesh.uv[mesh.faces].astype(float).transpose(1, 0, 2)
    (ux, uy), (wx, wy) = (v - u).T, (w - u).T
    shown = np.abs(ux * wy - uy * wx) / 2
    wall = (mesh.vertices[mesh.faces][:, :, 2].min(axis=1) > 0.39) & (
        mesh.vertices[mesh.faces][:, :, 2].max(axis=1) < 3.01
    )
    metres = np.sqrt(areas(mesh)[wall] / shown[wall])
    np.testing.assert_allclose(metres, metres.mean(), rtol=0.06)
    assert 0.7 < metres.mean() < 1.5
