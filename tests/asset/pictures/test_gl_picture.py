"""Pictures by OpenGL; they need its libraries, which the program itself does not."""

import dataclasses

import numpy as np
import pytest

from tests.asset.conftest import make_tree
from treefit.asset import AssetSettings, picture
from treefit.asset.pictures import gl_picture
from treefit.asset.pictures.picture import check_renderer
from treefit.opengl import gl_missing

SETTINGS = AssetSettings(renderer="pyrender", texture_size=64)
needs_gl = pytest.mark.skipif(gl_missing() is not None, reason=str(gl_missing()))


@pytest.fixture(scope="module")
def tree():
    return make_tree(branches=8, twigs=4, leaves=300)


def on_plant(image):
    """Pixels that are much darker or greener than sky and ground."""
    red, green, blue = np.moveaxis(image.astype(int), 2, 0)
    return (image.max(axis=2) < 150) | (green > np.maximum(red, blue) + 8)


@pytest.mark.gl
@needs_gl
def test_the_plant_stands_where_the_software_draws_it(tree):
    software = dataclasses.replace(SETTINGS, renderer="software")
    gl, own = (on_plant(picture(tree, settings, (160, 160))) for settings in (SETTINGS, software))
    assert (gl & own).sum() / (gl | own).sum() > 0.6  # twigs are thinner than a pixel


@pytest.mark.gl
@needs_gl
def test_leaves_are_cut_out_of_their_cards(tree):
    plain = on_plant(picture(tree, dataclasses.replace(SETTINGS, texture_size=0), (160, 160)))
    assert 0.5 * plain.sum() < on_plant(picture(tree, SETTINGS, (160, 160))).sum() < 1.5 * plain.sum()


def test_without_opengl_one_line_says_so_before_anything_is_drawn(tree, monkeypatch):
    monkeypatch.setattr(gl_picture, "gl_missing", lambda: "no OpenGL here")
    for ask in (lambda: check_renderer(SETTINGS), lambda: picture(tree, SETTINGS, 64)):
        with pytest.raises(ValueError, match=r"asset\.renderer=pyrender: no OpenGL here, asset\.renderer=software"):
            ask()
    check_renderer(AssetSettings())
    assert picture(tree, AssetSettings(), 64).shape[0] == 64
