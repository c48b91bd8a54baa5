"""Colours of bark and leaves that a picture shows."""

from __future__ import annotations

import numpy as np
import pytest
from skimage.color import rgb2lab

from treefit.asset.material.colour import Colour, to_linear
from treefit.asset.material.image_colours import image_colours
from treefit.asset.material.tree_materials import TreeColours
from treefit.mask import BRANCH, FOLIAGE, Mask

SKY: Colour = (170, 205, 245)


def scene(leaf: Colour, bark: Colour, shade: float = 0.5, sky: Colour = SKY) -> tuple[np.ndarray, Mask]:
    """Picture (160, 120, 3) of a round crown on a trunk: each pixel in more or less light, gaps with sky."""
    rng = np.random.default_rng(5)
    mask = np.zeros((160, 120), np.uint8)
    y, x = np.indices(mask.shape)
    mask[90:150, 54:66] = BRANCH
    mask[(y - 60) ** 2 + (x - 60) ** 2 < 50**2] = FOLIAGE
    rgb = np.empty((160, 120, 3))
    rgb[:] = sky
    for kind, colour in ((BRANCH, bark), (FOLIAGE, leaf)):
        lit = 1 - shade * rng.random(mask.shape)[..., None]
        rgb = np.where((mask == kind)[..., None], np.array(colour) * lit, rgb)
    gap = (mask == FOLIAGE) & (rng.random(mask.shape) < 0.15)
    rgb[gap] = sky
    return rgb.astype(np.uint8), mask


def apart(one: Colour, other: Colour) -> float:
    """Difference of hue and chroma in Lab."""
    lab = rgb2lab(np.array([[one, other]], np.uint8))[0]
    return float(np.linalg.norm(lab[0, 1:] - lab[1, 1:]))


@pytest.mark.parametrize("leaf", [(70, 110, 45), (190, 150, 30), (180, 60, 30), (60, 90, 80)])
@pytest.mark.parametrize("bark", [(105, 85, 65), (140, 140, 138)])
def test_bark_and_leaves_keep_their_hue(leaf: Colour, bark: Colour) -> None:
    found = image_colours(*scene(leaf, bark))
    assert found.leaf is not None
    assert found.bark is not None
    assert apart(found.leaf, leaf) < 14
    assert apart(found.bark, bark) < 10


def test_a_base_colour_is_lighter_than_the_picture_but_not_bleached() -> None:
    for leaf in ((60, 80, 40), (110, 160, 70), (220, 200, 60)):
        found = image_colours(*scene(leaf, (100, 80, 60))).leaf
        assert found is not None
        share = to_linear(found).sum() / to_linear(leaf).sum()
        assert 0.6 < share < 1.4
        assert max(found) < 235


def test_sky_between_the_leaves_is_left_out() -> None:
    blue, grey = (image_colours(*scene((70, 110, 45), (105, 85, 65), sky=sky)).leaf for sky in (SKY, (235, 235, 235)))
    assert blue is not None
    assert grey is not None
    assert apart(blue, grey) < 3


def test_a_silhouette_and_a_pencil_sketch_show_no_colours() -> None:
    rgb, mask = scene((10, 10, 10), (10, 10, 10))
    assert image_colours(rgb, mask) == TreeColours()
    rgb[:] = np.where((np.arange(120) % 6 == 0)[None, :, None], 40, 250)
    assert image_colours(rgb, mask) == TreeColours()


def test_a_dark_trunk_before_the_light_says_nothing_and_leaves_do() -> None:
    found = image_colours(*scene((200, 160, 30), (12, 12, 14)))
    assert found.bark is None
    assert found.leaf is not None


def test_what_is_not_in_the_picture_has_no_colour() -> None:
    rgb, mask = scene((70, 110, 45), (105, 85, 65))
    assert image_colours(rgb, np.where(mask == BRANCH, 0, mask).astype(np.uint8)).bark is None
    assert image_colours(rgb, np.zeros_like(mask)) == TreeColours()
    few = np.zeros_like(mask)
    few[100:103, 58:61] = BRANCH
    assert image_colours(rgb, few) == TreeColours()


def test_twigs_of_one_pixel_still_have_a_colour() -> None:
    rgb, _ = scene((120, 100, 80), (120, 100, 80), 0.2)
    mask = np.zeros(rgb.shape[:2], np.uint8)
    mask[20:100:4, 30:90] = BRANCH
    found = image_colours(rgb, mask)
    assert found.bark is not None
    assert apart(found.bark, (120, 100, 80)) < 8


def test_picture_and_mask_must_be_of_one_size() -> None:
    rgb, mask = scene((70, 110, 45), (105, 85, 65))
    with pytest.raises(ValueError, match="must be of one size"):
        image_colours(rgb, mask[:-1])
