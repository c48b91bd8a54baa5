import numpy as np

from treefit.image.belief import expected_overlap, finer
from treefit.image.guided import upsample
from treefit.mask import BACKGROUND, FOLIAGE

DARK, LIGHT = (40, 90, 30), (190, 210, 240)


def halves(height: int, width: int, edge: float) -> np.ndarray:
    """Picture that is dark left of the column `edge`, light right of it."""
    left = np.arange(width)[None, :, None] < edge
    return np.ascontiguousarray(np.broadcast_to(np.where(left, DARK, LIGHT), (height, width, 3))).astype(np.uint8)


def blurred(height: int, width: int, edge: float) -> np.ndarray:
    """(h, w) values from 1 to 0 in a wide slope around the column `edge`."""
    slope = np.clip(0.5 - (np.arange(width) + 0.5 - edge) / 8, 0, 1)
    return np.broadcast_to(slope, (height, width)).astype(np.float32)


def test_a_blurred_edge_becomes_that_of_the_large_picture() -> None:
    values = upsample(blurred(32, 48, 24)[..., None], halves(32, 48, 24), halves(320, 480, 240), 8, 1e-4)[..., 0]
    assert values.shape == (320, 480)
    assert values[:, 180:240].min() > 0.75
    assert values[:, 240:300].max() < 0.25


def test_values_of_a_plain_picture_keep_their_mean_and_range() -> None:
    values = np.random.default_rng(0).random((32, 48, 2), dtype=np.float32)
    found = upsample(values, halves(32, 48, 0), halves(64, 96, 0), 4, 1e-4)
    assert 0 <= found.min() <= found.max() <= 1
    np.testing.assert_allclose(found.mean(axis=(0, 1)), values.mean(axis=(0, 1)), atol=0.02)


def test_a_finer_belief_is_still_a_probability() -> None:
    belief = np.random.default_rng(1).dirichlet((1, 1, 1), (32, 48)).astype(np.float32)
    found = finer(belief, halves(100, 130, 70), 8)
    assert found.shape == (100, 130, 3)
    assert found.dtype == np.float32
    assert found.min() >= 0
    np.testing.assert_allclose(found.sum(axis=2), 1, atol=1e-5)


def test_the_expected_overlap_is_that_of_draws_from_the_belief() -> None:
    rng = np.random.default_rng(2)
    tree = rng.random((200, 200))
    belief = np.stack((1 - tree, np.zeros_like(tree), tree), axis=-1).astype(np.float32)
    mask = np.where(tree > 0.5, FOLIAGE, BACKGROUND).astype(np.uint8)
    drawn = rng.random(tree.shape) < tree
    overlap = (drawn & (mask > 0)).sum() / (drawn | (mask > 0)).sum()
    assert abs(expected_overlap(belief, mask) - overlap) < 0.02
    assert expected_overlap(belief, np.zeros_like(mask)) == 0
