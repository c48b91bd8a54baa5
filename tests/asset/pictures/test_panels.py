import numpy as np
import pytest

from treefit.asset.pictures.frame import BASE_SHARE, TREE_SHARE
from treefit.asset.pictures.panels import drawn_panels, given_panels


def post(height, width, top, base, at):
    mask = np.zeros((height, width), np.uint8)
    mask[top:base, at - 3 : at + 3] = 1
    return mask


def inked(panel):
    return np.asarray(panel).min(axis=2) < 128


@pytest.mark.parametrize("shape", [(300, 200), (90, 400)])
def test_every_tree_stands_on_the_baseline_in_the_column_that_is_told(shape):
    mask = post(*shape, 20, 80, 60)
    photo = np.where(mask[..., None] > 0, 0, 255).astype(np.uint8).repeat(3, axis=2)
    panels = given_panels(photo, mask, 200)
    for panel in (panels.picture, panels.mask):
        rows = np.flatnonzero(inked(panel)[:190].any(axis=1))
        assert rows[0] == pytest.approx((BASE_SHARE - TREE_SHARE) * 200, abs=2)
        column = np.flatnonzero(inked(panel)[100]).mean() + 0.5
        assert column == pytest.approx(panels.middle, abs=2)


def test_beyond_its_edge_a_picture_is_mirrored_and_a_mask_is_empty():
    mask = post(60, 60, 0, 60, 30)  # fills the picture from top to bottom
    photo = np.zeros((60, 60, 3), np.uint8)
    photo[:30], photo[30:] = (90, 120, 250), (40, 160, 40)
    panels = given_panels(photo, mask, 200)
    picture = np.asarray(panels.picture).astype(int)
    assert np.abs(picture[2] - (90, 120, 250)).max() < 4
    assert np.abs(picture[-2] - (40, 160, 40)).max() < 4
    assert (np.asarray(panels.mask)[[2, -2]] == 255).all()


def test_wider_panels_keep_the_trunk_over_its_mask():
    panels = drawn_panels(np.full((64, 48, 3), 200, np.uint8), post(64, 48, 4, 60, 24), 200)
    wide = panels.widened(panels.width + 51)
    assert wide.picture.size == wide.mask.size == (panels.width + 51, 200)
    assert np.flatnonzero(inked(wide.mask)[100]).mean() + 0.5 == pytest.approx(wide.middle, abs=2)
