import numpy as np
import pytest

from treefit.image.habit import is_cone
from treefit.mask import BRANCH, FOLIAGE


def crown(width_at) -> np.ndarray:
    """Mask of a crown whose share of the widest row at depth t in [0, 1] is width_at(t), over a trunk."""
    mask = np.zeros((120, 100), np.uint8)
    for row in range(100):
        half = max(1, round(45 * width_at(row / 99)))
        mask[row, 50 - half : 50 + half] = FOLIAGE
    mask[100:, 48:52] = BRANCH
    return mask


@pytest.mark.parametrize("width_at", [lambda t: t, lambda t: t**0.8, lambda t: t * (0.9 + 0.1 * np.cos(40 * t))])
def test_a_crown_that_widens_steadily_is_a_cone(width_at):
    assert is_cone(crown(width_at))


@pytest.mark.parametrize(
    "width_at",
    [lambda t: np.sqrt(1 - (2 * t - 1) ** 2), lambda t: 1.0, lambda t: 1 - t, lambda t: np.sqrt(t)],
    ids=["ball", "column", "upside down", "dome"],
)
def test_other_crowns_are_none(width_at):
    assert not is_cone(crown(width_at))


def test_a_tree_without_leaves_and_an_empty_mask_are_none():
    assert not is_cone(np.where(crown(lambda t: t) > 0, BRANCH, 0).astype(np.uint8))
    assert not is_cone(np.zeros((40, 30), np.uint8))
    assert not is_cone(crown(lambda t: t)[::8, ::8])
