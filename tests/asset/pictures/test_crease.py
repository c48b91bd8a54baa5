import numpy as np
import pytest

from treefit.asset.pictures.crease import creases


def test_an_even_surface_and_the_sky_keep_their_light():
    depth = np.full((160, 120), 3.0, np.float32)
    depth[:, :40] = np.inf
    left = creases(depth, 2, 10.0)
    assert left.shape == (80, 60)
    np.testing.assert_allclose(left, 1, atol=1e-5)


def test_a_gap_between_two_clumps_is_darker_and_the_clumps_are_not():
    depth = np.full((200, 200), 1.0, np.float32)
    depth[98:102] = 2.0
    left = creases(depth, 1, 10.0)
    assert left[100, 50] < 0.8
    assert left[80, 50] == pytest.approx(1, abs=1e-5)
    assert left[97, 50] == 1
