"""Trunks whose section is not round."""

import dataclasses

import numpy as np
import pytest

from tests.asset.bodies import areas, solid, wood
from treefit.asset.mesh import branch_meshes
from treefit.plant import Look

POLE = wood([[0, 0, 0], [0, 0, 1], [0, 0, 4]], [0.5, 0.4, 0.1], [-1, 0, 1], [0] * 3)


def lobed(plant, lobes=5, depth=0.1):
    return dataclasses.replace(plant, look=Look(lobes, depth))


def foot(mesh):
    """Corners (c, 2) of the lowest ring without its seam."""
    low = mesh.vertices[:, 2] < 1e-6
    rim = mesh.vertices[low & (np.linalg.norm(mesh.vertices[:, :2], axis=1) > 1e-6), :2]
    return rim[:-1]


@pytest.mark.parametrize(("lobes", "depth"), [(1, 0.3), (3, 0.1), (5, 0.07), (9, 0.03), (12, 0.3)])
def test_the_foot_has_the_radius_of_the_formula(lobes, depth):
    x, y = foot(branch_meshes(lobed(POLE, lobes, depth), plain=True)["trunk"]).T
    angle = np.arctan2(y, x)
    np.testing.assert_allclose(np.hypot(x, y), 0.5 * (1 + depth * np.sin(lobes * angle)), rtol=1e-5)
    assert len(x) >= 4 * lobes
    assert len(x) % lobes == 0


def test_lobes_fade_to_nothing_at_the_top_of_the_trunk():
    vertices = branch_meshes(lobed(POLE), plain=True)["trunk"].vertices
    for height, share in ((0, 1), (1, 0.75), (4, 0)):
        ring = vertices[np.abs(vertices[:, 2] - height) < 1e-6, :2]
        radius = np.hypot(*ring.T)
        radius = radius[radius > 1e-6]
        assert radius.max() / radius.min() == pytest.approx((1 + 0.1 * share) / (1 - 0.1 * share), rel=1e-5)


@pytest.mark.parametrize(("lobes", "depth"), [(1, 0.9), (3, 0.1), (5, 0.5), (12, 0.3), (24, 0.9)])
def test_a_lobed_trunk_is_a_closed_body(tree, lobes, depth):
    for mesh in branch_meshes(lobed(tree, lobes, depth)).values():
        body = solid(mesh)
        assert body.is_volume
        assert body.volume > 0
        assert areas(mesh).min() > 0
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-5)


def test_a_lobed_pole_has_the_volume_of_its_sections():
    height = np.linspace(0, 3, 200)
    pole = wood([[0, 0, z] for z in height], [0.5] * 200, range(-1, 199), [0] * 200)
    angle = 2 * np.pi * np.arange(33) / 33
    radius = 0.5 * (1 + 0.3 * (1 - height[:, None] / 3) * np.sin(3 * angle))
    section = 0.5 * np.sin(angle[1]) * (radius * np.roll(radius, -1, axis=1)).sum(axis=1)
    volume = np.trapezoid(section, height) + section[-1] * 0.25 / 3  # a pyramid half a radius high is the tip
    assert solid(branch_meshes(lobed(pole, 3, 0.3), 32, plain=True)["trunk"]).volume == pytest.approx(volume, rel=1e-4)


def test_normals_stand_on_the_swollen_surface():
    pole = wood([[0, 0, 10 * t] for t in np.linspace(0, 1, 60)], np.linspace(0.6, 0.2, 60), range(-1, 59), [0] * 60)
    mesh = branch_meshes(lobed(pole, 2, 0.2), 32)["trunk"]
    a, b, c = mesh.vertices[mesh.faces].astype(float).transpose(1, 0, 2)
    flat = np.cross(b - a, c - a)
    sum_of = np.zeros_like(mesh.normals, dtype=float)
    for corner in mesh.faces.T:
        np.add.at(sum_of, corner, flat)
    sum_of /= np.linalg.norm(sum_of, axis=1, keepdims=True)
    turn = np.arange(len(mesh.vertices) - 2) % 33
    inside = (turn > 0) & (turn < 32) & (mesh.vertices[:-2, 2] > 0.5) & (mesh.vertices[:-2, 2] < 9.5)
    assert ((sum_of * mesh.normals).sum(axis=1)[:-2][inside] > np.cos(np.radians(2))).all()


def test_only_stems_of_the_trunk_have_lobes_and_its_clones_too(tree):
    round_ones, lobed_ones = branch_meshes(tree, plain=True), branch_meshes(lobed(tree), plain=True)
    np.testing.assert_array_equal(round_ones["branches"].vertices, lobed_ones["branches"].vertices)
    assert len(lobed_ones["trunk"].vertices) > len(round_ones["trunk"].vertices)
    fork = wood([[0, 0, 0], [0, 0, 1], [0, 0, 4], [1, 0, 3]], [0.3, 0.2, 0.1, 0.1], [-1, 0, 1, 1], [0] * 4)
    assert (
        len(branch_meshes(lobed(fork), plain=True)["trunk"].vertices) == 5 * 21 + 2 + 2
    )  # rings, tips, middles of feet


@pytest.mark.parametrize(("lobes", "depth", "sides"), [(0, 0.5, 8), (5, 0.02, 8), (5, 0.5, 4), (25, 0.5, 8)])
def test_lobes_that_could_not_be_seen_cost_no_corner(tree, lobes, depth, sides):
    plain, mesh = branch_meshes(tree, sides)["trunk"], branch_meshes(lobed(tree, lobes, depth), sides)["trunk"]
    assert mesh.vertices.tobytes() == plain.vertices.tobytes()
    assert mesh.normals.tobytes() == plain.normals.tobytes()
