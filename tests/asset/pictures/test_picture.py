import dataclasses

import numpy as np
import pytest

from treefit.asset import AssetSettings, picture
from treefit.asset.pictures.frame import BASE_SHARE, TREE_SHARE


def bare(tree):
    none, size = np.zeros((0, 3), np.float32), np.zeros((0, 2), np.float32)
    return dataclasses.replace(tree, leaf_position=none, leaf_axis=none, leaf_normal=none, leaf_size=size)


def greenish(image):
    red, green, blue = np.moveaxis(image.astype(int), 2, 0)
    return (green > red + 8) & (green > blue + 8)


def test_the_same_plant_gives_the_same_pixels(tree):
    np.testing.assert_array_equal(picture(tree, AssetSettings(), 128), picture(tree, AssetSettings(), 128))


def test_sizes_are_those_asked_for(tree):
    assert picture(tree, AssetSettings(), (120, 200)).shape == (120, 200, 3)
    assert picture(tree, AssetSettings(picture_size=96)).shape[0] == 96


def test_the_tree_stands_at_the_shared_height_and_baseline(tree):
    image = picture(bare(tree), AssetSettings(bark="black"), 400)
    dark = image.max(axis=2) < 100  # even black bark shines a little
    rows = np.flatnonzero(dark.any(axis=1))
    assert rows[-1] + 1 == pytest.approx(BASE_SHARE * 400, abs=2)
    assert rows[-1] + 1 - rows[0] == pytest.approx(TREE_SHARE * 400, abs=12)
    foot = np.flatnonzero(dark[rows[-1] - 2])
    assert foot.mean() == pytest.approx(image.shape[1] / 2, abs=3)


def test_leaves_are_green_and_a_bare_tree_is_not(tree):
    assert greenish(picture(tree, AssetSettings(), 128)).mean() > 0.07
    assert greenish(picture(bare(tree), AssetSettings(), 128)).mean() < 0.001


def test_the_sun_comes_from_the_left_and_the_inside_of_the_crown_is_darker(tree):
    image = picture(tree, AssetSettings(), 256).mean(axis=2)
    leaves = greenish(picture(tree, AssetSettings(), 256))
    columns = np.broadcast_to(np.arange(image.shape[1]), image.shape)
    middle = np.median(columns[leaves])
    assert image[leaves & (columns < middle)].mean() > image[leaves & (columns > middle)].mean()


def test_a_plant_too_wide_for_the_picture_is_shown_whole(tree):
    image = picture(bare(tree), AssetSettings(bark="black"), (200, 60))
    dark = image.max(axis=2) < 100  # even black bark shines a little
    assert dark.any()
    assert not dark[:, [0, -1]].any()
