import numpy as np
import pytest
from PIL import Image

from experiments.stripes_figure import _CROWN, _HEIGHT, _TRUNK, stripes_figure, stripes_panel
from treefit.asset import GalleryEntry
from treefit.asset.pictures.frame import BASE_SHARE, TREE_SHARE
from treefit.asset.pictures.panels import Panels


def lollipop(height=200, width=160):
    """A block of leaves, 100 wide, on a trunk 20 wide."""
    mask = np.zeros((height, width), np.uint8)
    mask[20:100, 30:130] = 2
    mask[100:180, 70:90] = 1
    return mask


def panel(mask, count=20):
    blank = Image.new("RGB", (300, _HEIGHT))
    return np.asarray(stripes_panel(mask, count, Panels(blank, blank, 150.0))).astype(int)


def is_colour(image, colour):
    return (np.abs(image - colour) <= 8).all(axis=2)


def test_leaves_are_green_stripes_and_the_trunk_brown_ones_half_of_the_tree_each():
    image = panel(lollipop())
    middle = round((BASE_SHARE - TREE_SHARE / 2) * _HEIGHT)
    green, brown = is_colour(image, _CROWN[2]), is_colour(image, _TRUNK[1])
    assert green[:middle].sum() > 0.35 * middle * 125
    assert not green[middle + 1 :].any()
    assert brown[middle + 1 :].any()
    assert not brown[: middle - 1].any()


def test_lines_stand_at_the_borders_of_the_crown_and_of_the_trunk():
    image, tall = panel(lollipop()), TREE_SHARE * _HEIGHT
    for line, row, width in ((_CROWN[3], 0.3, 100 / 160), (_TRUNK[3], 0.8, 20 / 160)):
        at = round((BASE_SHARE - TREE_SHARE + row * TREE_SHARE) * _HEIGHT)
        strength = np.abs(image[at - 4 : at + 4] - line).sum(axis=2).min(axis=0)
        columns = np.flatnonzero(strength < 120)
        assert (columns.min(), columns.max()) == (
            pytest.approx(150 - width * tall / 2, abs=2),
            pytest.approx(150 + width * tall / 2, abs=2),
        )


def test_a_row_for_the_picture_and_each_candidate_with_three_panels():
    photo = np.full((200, 160, 3), 90, np.uint8)
    entry = GalleryEntry("candidate 1", np.full((64, 48, 3), 200, np.uint8), lollipop(), ("score 0.9", "more"))
    one, two = (stripes_figure(photo, lollipop(), [entry] * n) for n in (1, 2))
    assert one.dtype == np.uint8
    assert one.shape[1] == two.shape[1]
    assert two.shape[0] - one.shape[0] > _HEIGHT
    np.testing.assert_array_equal(one, stripes_figure(photo, lollipop(), [entry]))


def test_a_candidate_without_a_tree_has_an_empty_panel():
    assert len(np.unique(panel(np.zeros((40, 40), np.uint8)).reshape(-1, 3), axis=0)) == 1


def test_more_stripes_than_rows_of_the_mask_are_drawn_as_well():
    assert is_colour(panel(lollipop(), 300), _CROWN[2]).any()
