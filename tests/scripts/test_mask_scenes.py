from collections import Counter

import numpy as np
import pytest

from scripts.mask_training.contact_sheet import sheet
from scripts.mask_training.scene import KINDS, LEAST, kind_of, scene
from scripts.mask_training.scenery.labels import closed, large, person_labels
from scripts.mask_training.scenery.render import Layer
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, check_mask

pytestmark = pytest.mark.slow

SIZE = 96
FIRST = {kind: next(index for index in range(2000) if kind_of(0, index) == kind) for kind in KINDS}


@pytest.mark.parametrize("kind", KINDS)
def test_a_scene_is_a_picture_of_a_tree_and_its_classes(kind: str) -> None:
    rgb, classes = scene(0, FIRST[kind], SIZE)
    assert rgb.shape == (SIZE, SIZE, 3)
    assert rgb.dtype == np.uint8
    assert classes.shape == (SIZE, SIZE)
    assert classes.dtype == np.uint8
    check_mask(classes)
    assert LEAST <= (classes != BACKGROUND).mean() < 1
    assert rgb.std() > 2


@pytest.mark.parametrize("kind", KINDS)
def test_the_same_numbers_give_the_same_bytes_in_any_order(kind: str) -> None:
    first = scene(0, FIRST[kind], SIZE)
    scene(0, FIRST[kind] + 1, SIZE)
    second = scene(0, FIRST[kind], SIZE)
    assert first[0].tobytes() == second[0].tobytes()
    assert first[1].tobytes() == second[1].tobytes()


def test_other_numbers_give_other_scenes() -> None:
    pictures = {scene(seed, index, 48)[0].tobytes() for seed in range(2) for index in range(4)}
    assert len(pictures) == 8


def test_every_kind_has_its_share() -> None:
    count = 4000
    found = Counter(kind_of(1, index) for index in range(count))
    for kind, share in KINDS.items():
        assert found[kind] / count == pytest.approx(share, abs=4 * (share / count) ** 0.5)


def test_classes_have_the_shares_of_pictures_of_trees() -> None:
    classes = np.stack([scene(2, index, SIZE)[1] for index in range(40)])
    assert 0.5 < (classes == BACKGROUND).mean() < 0.85
    assert 0.12 < (classes == FOLIAGE).mean() < 0.45
    assert 0.008 < (classes == BRANCH).mean() < 0.08
    assert ((classes == BRANCH).any(axis=(1, 2))).mean() > 0.7


def test_small_gaps_are_closed_before_land_and_seen_before_the_sky() -> None:
    leaf = np.zeros((SIZE, SIZE), np.float32)
    leaf[20:70, 20:70] = 1
    leaf[44:46, 44:46] = 0
    layer = Layer(np.zeros((SIZE, SIZE, 3), np.float32), np.zeros_like(leaf), leaf, np.zeros_like(leaf))
    over_sky = person_labels(layer, np.zeros_like(leaf), False)
    over_land = person_labels(layer, np.ones_like(leaf), False)
    assert over_sky[45, 45] == BACKGROUND
    assert over_land[45, 45] == FOLIAGE


def test_a_trunk_under_the_crown_is_branch_and_twigs_within_are_foliage() -> None:
    wood, leaf, twig = np.zeros((3, SIZE, SIZE), np.float32)
    leaf[10:60, 20:70] = 1
    wood[60:90, 42:48] = 1
    twig[30:40, 44:45], leaf[30:40, 44:45] = 1, 0
    classes = person_labels(Layer(np.zeros((SIZE, SIZE, 3), np.float32), wood, leaf, twig), np.ones_like(leaf), False)
    assert (classes[62:88, 43:47] == BRANCH).all()
    assert (classes[30:40, 44] == FOLIAGE).all()


def test_all_of_a_bare_tree_is_branch() -> None:
    twig = np.zeros((SIZE, SIZE), np.float32)
    twig[20:80, 40:44] = 1
    layer = Layer(np.zeros((SIZE, SIZE, 3), np.float32), np.zeros_like(twig), np.zeros_like(twig), twig)
    classes = person_labels(layer, np.zeros_like(twig), True)
    assert set(np.unique(classes)) == {BACKGROUND, BRANCH}


def test_closing_fills_what_is_narrower_than_its_width_and_keeps_the_outline() -> None:
    mask = np.zeros((40, 40), bool)
    mask[10:30, 10:30] = True
    gaps = mask.copy()
    gaps[18:21, 12:28] = False
    assert np.array_equal(closed(gaps, 2.5), mask)
    assert not closed(gaps, 1.0)[19, 20]


def test_specks_are_dropped() -> None:
    mask = np.zeros((20, 20), bool)
    mask[2:10, 2:10] = True
    mask[15, 15] = True
    kept = large(mask, 4)
    assert kept.sum() == 64
    assert not kept[15, 15]


def test_the_contact_sheet_shows_each_scene_beside_its_overlay() -> None:
    assert sheet(0, range(2), 48).size == (12 * 48, 48)
