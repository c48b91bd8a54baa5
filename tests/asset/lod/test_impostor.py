"""Crossed cards: where they stand, and what is on them."""

import numpy as np
import pytest

from tests.asset.conftest import make_tree
from treefit.asset import AssetSettings
from treefit.asset.lod.bake import cut_out
from treefit.asset.lod.impostor import CUTOFF, impostor
from treefit.asset.model import Model, model_of


@pytest.fixture(scope="module")
def whole() -> Model:
    return model_of(make_tree(branches=18, twigs=6, leaves=1500), AssetSettings(texture_size=64))


@pytest.mark.parametrize("sides", [2, 3])
def test_cards_cross_at_the_trunk_and_are_as_high_as_the_plant(whole, sides):
    mesh = impostor(whole, sides, 128).parts["impostor"].mesh
    places = np.concatenate([part.mesh.vertices for part in whole.parts.values()])
    assert len(mesh.faces) == 2 * sides
    assert mesh.vertices[:, 2].min() == pytest.approx(places[:, 2].min(), abs=1e-4)
    assert mesh.vertices[:, 2].max() == pytest.approx(places[:, 2].max(), abs=1e-4)
    assert np.allclose(mesh.vertices.reshape(sides, 4, 3)[..., :2].mean(axis=1), 0, atol=1e-4)
    assert np.hypot(*mesh.vertices[:, :2].T).max() == pytest.approx(np.hypot(*places[:, :2].T).max(), rel=1e-4)


def test_faces_turn_to_the_side_of_their_normals(whole):
    mesh = impostor(whole, 3, 64).parts["impostor"].mesh
    a, b, c = mesh.vertices[mesh.faces].transpose(1, 0, 2)
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), mesh.normals[mesh.faces[:, 0]]) > 0).all()


def test_the_material_says_how_it_is_to_be_drawn(whole):
    material = impostor(whole, 3, 128).parts["impostor"].material
    assert (material.name, material.cutoff, material.two_sided) == ("impostor", 0.5, True)
    assert material.base.shape == (128, 128, 4)
    assert material.normal.shape == (128, 128, 3)


def test_the_ground_is_bark_and_the_crown_is_leaves(whole):
    part = impostor(whole, 2, 256).parts["impostor"]
    base = part.material.base
    cell = (part.mesh.uv[:4] * 256).round().astype(int)  # of the first card
    left, right, bottom, top = cell[0, 0], cell[1, 0], 256 - cell[0, 1], 256 - cell[2, 1]
    tall, wide = bottom - top, right - left
    trunk = base[bottom - tall // 12, left + wide // 2]
    crown = base[top + tall // 4 : top + tall // 2, left:right]
    leaves = crown[crown[..., 3] >= 128].astype(float).mean(axis=0)
    assert trunk[3] >= 128
    assert trunk[0] > trunk[1]  # red over green
    assert leaves[1] > leaves[0]


def test_colours_go_on_where_nothing_is_seen(whole):
    base = impostor(whole, 2, 128).parts["impostor"].material.base
    assert (base[base[..., 3] == 0][:, :3].max(axis=1) > 0).mean() > 0.99


def test_alpha_passes_on_as_much_as_is_covered():
    rng = np.random.default_rng(0)
    share = (rng.random((64, 64)) ** 3).astype(np.float32)
    assert (cut_out(share, CUTOFF) >= CUTOFF).mean() == pytest.approx(share.mean(), abs=0.01)


def test_what_is_covered_wholly_is_opaque():
    alpha = cut_out(np.ones((20, 20), np.float32), CUTOFF)
    assert (alpha == 1).all()
