"""What the vertices know of wind and of the sky."""

import dataclasses

import numpy as np
import pytest

from treefit.asset import AssetSettings
from treefit.asset.mesh import crown_of, leaf_mesh, stems_of, tubes_of
from treefit.asset.mesh.wind import sway
from treefit.asset.model import model_of


@pytest.fixture(scope="module")
def model(tree):
    return model_of(tree, AssetSettings(texture_size=0))


def test_every_part_knows_wind_and_openness_as_shares(model):
    for part in model.parts.values():
        for numbers in (part.mesh.wind, part.mesh.openness):
            assert numbers.dtype == np.float32
            assert 0 <= numbers.min() <= numbers.max() <= 1
        assert part.mesh.openness.min() > 0.04  # never black


def test_the_root_stands_still_and_twigs_move_most(tree, model):
    trunk, leaves = model.parts["trunk"].mesh, model.parts["leaves"].mesh
    assert trunk.wind[trunk.vertices[:, 2] <= 0, 0].max() < 0.01
    assert leaves.wind[:, 0].mean() > 2 * trunk.wind[:, 0].mean()
    stems = stems_of(tree)
    bend, _ = sway(stems)
    inside = np.diff(stems.stem) == 0
    assert (np.diff(bend)[inside] >= 0).all()
    assert bend.max() == 1


def test_a_branch_has_one_phase_with_all_that_grows_on_it_and_joints_do_not_tear(tree):
    stems = stems_of(tree)
    bend, phase = sway(stems)
    for stem in np.flatnonzero(stems.level == 2):
        own = phase[stems.first[stem] + 1 : stems.first[stem + 1]]
        host = stems.stem[stems.host[stem]]
        np.testing.assert_array_equal(own, phase[stems.first[host + 1] - 1])
    low, host, share = stems.first[1:-1], stems.host[1:], stems.share[1:]
    np.testing.assert_allclose(bend[low], bend[host] * (1 - share) + bend[host + (share > 0)] * share, rtol=1e-3)
    np.testing.assert_array_equal(phase[low], phase[host])
    beats = {phase[stems.first[stem + 1] - 1] for stem in np.flatnonzero(stems.level == 1)}
    assert len(beats) == (stems.level == 1).sum()


def test_leaves_move_with_their_branch_and_flutter_to_their_tips(tree, model):
    leaves = model.parts["leaves"].mesh
    wind = leaves.wind.reshape(tree.n_leaves, -1, 3)
    assert (wind[:, :, :2] == wind[:, :1, :2]).all()
    assert (wind[:, 0, 2] == 0).all()
    assert (wind[:, :, 2].max(axis=1) == 1).all()
    wood = {float(phase) for name in ("trunk", "branches") for phase in model.parts[name].mesh.wind[:, 1]}
    assert {float(phase) for phase in wind[:, 0, 1]} <= wood


def test_leaves_hang_on_the_curves_of_their_stems(tree):
    stems = stems_of(tree)
    on_wood = dataclasses.replace(tree, leaf_position=(tree.position[tree.parent[200:]] + tree.position[200:]) / 2,
                                  **{name: getattr(tree, name)[: tree.n_vertices - 200] for name in
                                     ("leaf_axis", "leaf_normal", "leaf_size")})  # fmt: skip
    plain, hung = (leaf_mesh(on_wood, stems=chosen).vertices for chosen in (None, stems))
    moved = np.linalg.norm((hung - plain).reshape(on_wood.n_leaves, -1, 3), axis=2)
    np.testing.assert_allclose(moved, moved[:, :1].repeat(moved.shape[1], axis=1), atol=1e-5)
    assert 0.001 < moved.max() < 0.2


def test_leaves_show_their_fronts_and_normals_to_the_outside(tree):
    crown = crown_of(tree)
    mesh = leaf_mesh(tree, crown=crown)
    corners = mesh.vertices.reshape(tree.n_leaves, -1, 3)
    middle = corners.mean(axis=1)
    out = middle - middle.mean(axis=0)
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    shown = (mesh.normals.reshape(tree.n_leaves, -1, 3).mean(axis=1) * out).sum(axis=1)
    bare = (leaf_mesh(tree).normals.reshape(tree.n_leaves, -1, 3).mean(axis=1) * out).sum(axis=1)
    assert shown.mean() > 0.7 > np.abs(bare).mean()
    a, b, c = mesh.vertices[mesh.faces].transpose(1, 0, 2)
    flat = np.cross(b - a, c - a)
    assert ((flat * mesh.normals[mesh.faces].mean(axis=1)).sum(axis=1) > 0).mean() > 0.95


def test_the_inside_of_a_crown_and_the_ground_around_the_trunk_are_darker(tree, model):
    leaves, trunk = model.parts["leaves"].mesh, model.parts["trunk"].mesh
    middle = leaves.vertices.mean(axis=0)
    far = np.linalg.norm(leaves.vertices - middle, axis=1)
    inside, outside = far < np.quantile(far, 0.2), far > np.quantile(far, 0.8)
    assert leaves.openness[inside].mean() < 0.75 * leaves.openness[outside].mean()
    bare = tubes_of(stems_of(tree), None, 7)["trunk"]
    low, high = bare.vertices[:, 2] < 0.05, bare.vertices[:, 2] > 1.2
    assert bare.openness[low].max() < bare.openness[high].min()
    assert (trunk.openness <= bare.openness + 1e-6).all()


def test_a_plant_without_leaves_is_shaded_by_its_twigs(tree):
    none = {name: getattr(tree, name)[:0] for name in ("leaf_position", "leaf_axis", "leaf_normal", "leaf_size")}
    seen = crown_of(dataclasses.replace(tree, **none)).sky_seen(np.array([[0, 0, 4], [0, 0, 99]], np.float32))
    assert 0.3 < seen[0] < seen[1] <= 1
