"""Which outline a leaf gets, and what each is like."""

import dataclasses
import math

import numpy as np
import pytest

from treefit.asset import AssetSettings
from treefit.asset.mesh.leaf_outline import leaf_card, leaf_frame, outline_of, plain_card
from treefit.asset.model import model_of
from treefit.plant import LEAF_SHAPES, Look
from treefit.plant.leaf_shape import LARGE, LARGE_SHARE
from treefit.plant.look import SPRIGS

TRIANGLES = {
    "broad": 4, "round": 6, "narrow": 4, "lobed": 8, "needle": 2, "tuft": 9, "frond": 24, "oak": 10, "compound": 19,
    "scale": 14, **dict.fromkeys(SPRIGS.values(), 4),
}  # fmt: skip


def dressed(plant, look, length=0.1, width=0.6):
    """The plant with `look` and leaves of `length` m."""
    size = np.tile(np.float32([length, width * length]), (plant.n_leaves, 1))
    return dataclasses.replace(plant, look=look, leaf_size=size)


def test_the_wish_of_the_plant_counts_unless_the_user_has_one(tree):
    tuft = dressed(tree, Look(leaf_shape="tuft"))
    assert outline_of("auto", dressed(tree, None)) == outline_of("auto", dressed(tree, Look())) == "broad"
    assert outline_of("auto", tuft) == "tuft"
    assert outline_of("round", tuft) == "round"


def test_without_a_wish_slender_leaves_are_needles(tree):
    for plant, shape in ((dressed(tree, Look()), "broad"), (dressed(tree, Look(), width=0.2), "tuft")):
        assert outline_of("auto", plant) == shape
        mesh = model_of(plant, AssetSettings(texture_size=0)).parts["leaves"].mesh
        assert len(mesh.faces) == TRIANGLES[shape] * plant.n_leaves
    assert outline_of("auto", dressed(tree, Look(leaf_shape="narrow"), width=0.2)) == "narrow"


@pytest.mark.parametrize("shape", LEAF_SHAPES)
def test_leaves_too_large_for_a_leaf_are_sprigs_where_there_are_sprigs_of_them(tree, shape):
    height = tree.position[:, 2].max()
    limit = max(LARGE, LARGE_SHARE * height)
    look = Look(leaf_shape=shape)
    assert outline_of("auto", dressed(tree, look, 0.99 * limit)) == shape
    assert outline_of("auto", dressed(tree, look, 1.01 * limit)) == SPRIGS.get(shape, shape)
    assert outline_of(shape, dressed(tree, look, 1.01 * limit)) == shape


def test_large_leaves_of_a_tall_tree_are_leaves(tree):
    tall = dataclasses.replace(tree, position=tree.position * np.float32(10))
    assert tall.position[:, 2].max() > LARGE / LARGE_SHARE
    assert outline_of("auto", dressed(tall, None, 1.2 * LARGE)) == "broad"


def test_a_few_large_leaves_make_no_sprigs(tree):
    size = np.full((tree.n_leaves, 2), 0.9 * LARGE, dtype=np.float32)
    size[: tree.n_leaves // 3] = 1.0
    assert outline_of("auto", dataclasses.replace(tree, leaf_size=size, look=None)) == "broad"


@pytest.mark.parametrize("shape", LEAF_SHAPES)
def test_files_have_the_outline_of_the_plant(tree, shape):
    told = model_of(dataclasses.replace(tree, look=Look(leaf_shape=shape)), AssetSettings()).parts["leaves"].mesh
    chosen = model_of(tree, AssetSettings(leaf_outline=shape)).parts["leaves"].mesh
    assert told.vertices.tobytes() == chosen.vertices.tobytes()
    assert len(told.faces) == TRIANGLES[shape] * tree.n_leaves


@pytest.mark.parametrize("fold", [0, 18, 60])
@pytest.mark.parametrize("shape", LEAF_SHAPES)
def test_a_card_is_seen_from_its_normal_and_stays_near_the_unit_square(shape, fold):
    card = leaf_card(shape, fold)
    a, b, c = card.place[card.faces].astype(float).transpose(1, 0, 2)
    flat = np.cross(b - a, c - a)
    assert (flat[:, 2] > 0).all()
    assert (np.einsum("tx,tcx->tc", flat, card.normal[card.faces]) > 0).all()
    np.testing.assert_allclose(np.linalg.norm(card.normal, axis=1), 1, atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(flat, axis=1).sum() / 2, math.pi / 4, rtol=1e-5)
    assert card.uv.min() >= 0
    assert card.uv.max() <= 1
    assert card.place[:, 1].min() == 0
    assert card.place[:, 1].max() == pytest.approx(1)
    assert np.linalg.norm(card.place[:, [0, 2]], axis=1).max() < 1.3


@pytest.mark.parametrize("shape", LEAF_SHAPES)
def test_a_plain_card_is_the_square_of_the_texture_around_the_leaf(shape):
    card, plain = leaf_card(shape), plain_card(shape)
    assert len(plain.faces) == 2
    assert sorted(map(tuple, plain.uv)) == [(0, 0), (0, 1), (1, 0), (1, 1)]
    a, b, c = plain.place[plain.faces].astype(float).transpose(1, 0, 2)
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()
    assert (plain.place[:, 2] == 0).all()
    assert np.ptp(plain.place[:, 1]) < 1.1
    if shape != "tuft":  # all others lie flat, and then the same place has the same texel on both cards
        np.testing.assert_allclose(leaf_frame(shape).xy(card.uv), card.place[:, :2], atol=1e-6)
    np.testing.assert_allclose(leaf_frame(shape).xy(plain.uv), plain.place[:, :2], atol=1e-6)
    assert 0 < card.uv.min() < card.uv.max() < 1


def test_needles_of_a_tuft_stand_out_on_all_sides():
    place = leaf_card("tuft").place
    tips = place[np.linalg.norm(place[:, [0, 2]], axis=1) > 0]
    turn = np.sort(np.arctan2(tips[:, 2], tips[:, 0]))
    gaps = np.diff(np.append(turn, turn[0] + 2 * np.pi))
    assert gaps.max() <= math.pi / 3 + 1e-5


def test_a_folded_frond_raises_its_leaflets():
    assert np.abs(leaf_card("frond").place[:, 2]).max() < 1e-6
    place = leaf_card("frond", 30).place
    np.testing.assert_allclose(place[:, 2], np.abs(place[:, 0]) * math.tan(math.radians(30)), atol=1e-6)
