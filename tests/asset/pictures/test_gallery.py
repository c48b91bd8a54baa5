import numpy as np
import pytest

from treefit.asset import GalleryEntry, gallery
from treefit.asset.pictures.gallery import _HEIGHT, _MARGIN, _TOP
from treefit.mask import PALETTE


def standing(height, width, left, right, top, bottom):
    """A mask with a block of leaves on a trunk."""
    mask = np.zeros((height, width), np.uint8)
    mask[top : (top + bottom) // 2, left:right] = 2
    middle = (left + right) // 2
    mask[(top + bottom) // 2 : bottom, middle - 2 : middle + 2] = 1
    return mask


def entry(name="one", captions=("score 0.9",), mask=None):
    return GalleryEntry(
        name, np.full((64, 48, 3), 200, np.uint8), standing(64, 48, 8, 40, 0, 64) if mask is None else mask, captions
    )


def test_all_masks_stand_at_one_height_on_one_baseline():
    target = standing(300, 400, 100, 220, 60, 250)
    image = gallery(np.full((300, 400, 3), 255, np.uint8), target, [entry(mask=standing(90, 90, 20, 70, 30, 80))], "t")
    lower = image[_TOP + _HEIGHT : _TOP + 2 * _HEIGHT + 16]
    shown = (lower == PALETTE[1]).all(axis=2) | (lower == PALETTE[2]).all(axis=2)
    columns = np.flatnonzero(shown.any(axis=0))
    split = columns[np.argmax(np.diff(columns)) + 1]
    spans = [np.flatnonzero(half.any(axis=1))[[0, -1]] for half in (shown[:, :split], shown[:, split:])]
    np.testing.assert_allclose(spans[0], spans[1], atol=5)


def test_the_picture_stands_over_its_mask_whatever_its_size():
    mask = standing(100, 100, 30, 70, 10, 90)
    photo = np.kron(np.where(mask[..., None] > 0, 0, 255).astype(np.uint8), np.ones((3, 3, 3), np.uint8))
    image = gallery(photo, mask, [], "t").astype(int)
    upper, lower = image[_TOP : _TOP + _HEIGHT, _MARGIN + 2 :], image[_TOP + _HEIGHT + 16 :][:_HEIGHT, _MARGIN + 2 :]
    dark = upper.max(axis=2) < 128
    inside = np.s_[4 : _HEIGHT - 4]
    assert (dark[inside] == (lower.min(axis=2) < 128)[inside]).mean() > 0.98


def test_long_and_strange_texts_are_kept_on_their_line():
    image = gallery(
        np.zeros((40, 40, 3), np.uint8),
        standing(40, 40, 5, 30, 2, 38),
        [entry("é\n" * 90, ("x" * 300, ""))],
        "ä ß 木 " * 99,
    )
    assert image.dtype == np.uint8
    assert image.shape[1] < 1200


def test_an_empty_mask_of_a_candidate_is_shown_as_such():
    blank = np.zeros((30, 30), np.uint8)
    assert gallery(np.zeros((40, 40, 3), np.uint8), standing(40, 40, 5, 30, 2, 38), [entry(mask=blank)], "").ndim == 3


def test_a_target_that_is_no_mask_is_refused():
    with pytest.raises(ValueError, match="must be 0 background"):
        gallery(np.zeros((4, 4, 3), np.uint8), np.full((4, 4), 9, np.uint8), [], "")
