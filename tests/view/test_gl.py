"""OpenGL's masks; they need its libraries, which the program itself does not."""

import os
import subprocess
import sys

import numpy as np
import pytest

from treefit.opengl import gl_missing
from treefit.plant import Plant
from treefit.view.gl import gl_mask

needs_gl = pytest.mark.skipif(gl_missing() is not None, reason=str(gl_missing()))


def post() -> Plant:
    """A post of 2 m and 0.2 m width with one square metre leaf to its right, in front of nothing."""
    leaf = [np.array([row], np.float32) for row in ([0.2, 0, 1.5], [1, 0, 0], [0, -1, 0])]
    return Plant(
        np.array([[0, 0, 0], [0, 0, 2]], np.float32), np.array([0.1, 0.1], np.float32), np.array([-1, 0], np.int32),
        np.zeros(2, np.int32), *leaf, np.array([[0.8, 0.6]], np.float32),
    )  # fmt: skip


@pytest.mark.gl
@needs_gl
def test_classes_lie_where_the_front_view_has_them():
    mask = gl_mask(post(), 200, 0.75)
    assert mask.shape == (200, 300)
    assert (mask[100, 141:159] == 1).all()
    assert not mask[100, :139].any()
    assert mask[50, 210] == 2
    assert (mask == 1).sum() == pytest.approx(20 * 200, rel=0.06)
    assert (mask == 2).sum() == pytest.approx(np.pi / 4 * 80 * 60, rel=0.02)


@pytest.mark.gl
@needs_gl
def test_a_leaf_is_seen_from_behind_too():
    front, plant = gl_mask(post(), 100, 0.75), post()
    plant.leaf_normal[:] *= -1
    assert (gl_mask(plant, 100, 0.75) == 2).sum() == pytest.approx((front == 2).sum(), abs=4)


def test_what_is_missing_is_said_in_one_line_without_a_crash():
    code = "from treefit.opengl import gl_missing; import sys; sys.stderr.write(str(gl_missing()))"
    place = os.environ | {"PYOPENGL_PLATFORM": "osmesa"}
    done = subprocess.run([sys.executable, "-c", code], env=place, capture_output=True, text=True, check=True)
    assert done.stdout == ""
    assert done.stderr == "None" or "apt-get install libegl1 libgl1 libxrender1" in done.stderr.splitlines()[-1]
