import numpy as np
import pytest

from treefit.image.overlay import overlay
from treefit.image.picture import Picture
from treefit.image.read import PictureError
from treefit.image.warnings import judge
from treefit.mask import BRANCH, FOLIAGE


def tree(left: int = 100, right: int = 200, top: int = 50, bottom: int = 300) -> np.ndarray:
    mask = np.zeros((300, 300), np.uint8)
    mask[top:bottom, left:right] = FOLIAGE
    return mask


def test_a_whole_tree_whose_trunk_leaves_at_the_bottom_is_not_warned_of() -> None:
    assert judge(tree()) == ()


@pytest.mark.parametrize(
    ("mask", "message"),
    [
        (tree(left=0), "cut off at the left of"),
        (tree(right=300), "cut off at the right of"),
        (tree(top=0), "cut off at the top of"),
        (tree(left=0, top=0), "cut off at the top and left of"),
        (tree(bottom=150), "only 100 pixels high"),
        (tree(left=140, right=142, bottom=250), "almost no tree: 0.44%"),
        (tree(right=140) | tree(left=220, right=260), "2 separate parts of like size"),
    ],
)
def test_what_would_spoil_a_fit_is_said(mask: np.ndarray, message: str) -> None:
    assert any(message in warning for warning in judge(mask))


def test_no_tree_at_all_is_an_error_that_tells_the_cure() -> None:
    with pytest.raises(PictureError, match=r"no tree was found in the picture; show it with mask\.point"):
        judge(np.zeros((100, 100), np.uint8))


def test_the_overlay_tints_the_classes_and_draws_the_outline() -> None:
    mask = tree()
    mask[200:, 140:160] = BRANCH
    shown = overlay(Picture(np.full((300, 300, 3), 128, np.uint8)), mask)
    assert shown.shape == (300, 300, 3)
    assert shown[100, 150, 1] > shown[100, 150, 0]
    assert shown[250, 150, 0] > shown[250, 150, 2]
    assert tuple(shown[100, 100]) == (255, 0, 200)
    assert (shown[10, 10] > 128).all()


def test_an_overlay_needs_one_size() -> None:
    with pytest.raises(ValueError, match="must have one size"):
        overlay(Picture(np.zeros((10, 10, 3), np.uint8)), tree())
