"""Which outline a leaf gets, and what each is like."""

import dataclasses
import math

import numpy as np
import pytest

from treefit.asset import AssetSettings
from treefit.asset.mesh.leaf_outline import leaf_card, outline_of
from treefit.asset.model import model_of
from treefit.plant import LEAF_SHAPES, Look

TRIANGLES = {"broad": 4, "round": 6, "narrow": 4, "lobed": 8, "needle": 2, "tuft": 9, "frond": 24}


def test_the_wish_of_the_plant_counts_unless_the_user_has_one():
    assert outline_of("auto", None) == outline_of("auto", Look()) == "broad"
    assert outline_of("auto", Look(leaf_shape="tuft")) == "tuft"
    assert outline_of("round", Look(leaf_shape="tuft")) == "round"


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
