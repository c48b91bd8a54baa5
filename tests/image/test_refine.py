import numpy as np
import pytest
from scipy import ndimage

from treefit.image.belief import Belief
from treefit.image.picture import Picture
from treefit.image.refine import refine
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE

SIDE = 192
GREEN, RED, BROWN, SKY, LAWN = (60, 110, 40), (120, 35, 45), (80, 60, 45), (150, 185, 240), (110, 150, 60)
ROWS, COLUMNS = np.mgrid[:SIDE, :SIDE]
CROWN = np.hypot(ROWS - 75, COLUMNS - 96) < 55
TRUNK = (np.abs(COLUMNS - 96) < 6) & (ROWS >= 125) & (ROWS < 172)
NEIGHBOUR = (np.hypot(ROWS - 85, COLUMNS - 165) < 45) & ~CROWN


def scene(*, neighbour: bool = False, gap: bool = False) -> Picture:
    """A green tree on a lawn, perhaps a red one behind it and a hole in its crown through which the sky shows."""
    rgb = np.empty((SIDE, SIDE, 3))
    rgb[:] = SKY
    rgb[140:] = LAWN
    if neighbour:
        rgb[NEIGHBOUR] = RED
    rgb[CROWN], rgb[TRUNK] = GREEN, BROWN
    rough = CROWN | TRUNK | (ROWS >= 140) | (NEIGHBOUR & neighbour)
    rgb[rough] += np.random.default_rng(0).normal(0, 18, (SIDE, SIDE, 3))[rough]
    if gap:
        rgb[70:84, 80:94] = SKY
    return Picture(np.clip(rgb, 0, 255).astype(np.uint8))


def blurred(foliage: np.ndarray, branch: np.ndarray, most: float = 0.97) -> Belief:
    """Belief of a network that is unsure at edges."""
    belief = np.zeros((SIDE, SIDE, 3), np.float32)
    for kind, region in ((FOLIAGE, foliage), (BRANCH, branch)):
        belief[..., kind] = most * ndimage.gaussian_filter(region.astype(np.float32), 3)
    belief[..., BACKGROUND] = 1 - belief.sum(axis=2)
    return np.clip(belief, 0, 1)


def iou(found: np.ndarray, expected: np.ndarray) -> float:
    return float((found & expected).sum() / (found | expected).sum())


def test_a_blurred_belief_gets_the_edges_of_the_picture() -> None:
    picture, belief = scene(), blurred(CROWN, TRUNK)
    found = refine(belief, picture, picture.rgb)
    assert iou(found, CROWN | TRUNK) > 0.97
    assert iou(found, CROWN | TRUNK) > iou(belief[..., BACKGROUND] < 0.5, CROWN | TRUNK)


def test_a_neighbour_of_another_colour_is_left_out_though_the_network_took_it_for_the_tree() -> None:
    picture, belief = scene(neighbour=True), blurred(CROWN | NEIGHBOUR, TRUNK, most=0.8)
    assert iou(belief[..., BACKGROUND] < 0.5, CROWN | TRUNK) < 0.8
    assert iou(refine(belief, picture, picture.rgb), CROWN | TRUNK) > 0.85


def test_sky_that_shows_through_the_crown_is_background() -> None:
    picture = scene(gap=True)
    found = refine(blurred(CROWN, TRUNK, most=0.9), picture, picture.rgb)
    assert found[72:82, 82:92].mean() < 0.1
    assert found[60:68, 82:92].all()


def test_lawn_around_the_foot_is_not_tree() -> None:
    lawn = (np.hypot((ROWS - 172) * 3, COLUMNS - 96) < 40) & (ROWS > 160) & ~TRUNK
    picture, belief = scene(), blurred(CROWN, TRUNK)
    belief[lawn] = (0.4, 0, 0.6)
    found = refine(belief, picture, picture.rgb)
    assert found[lawn].mean() < 0.1
    assert found[TRUNK].mean() > 0.9


@pytest.mark.parametrize("times", [1, 3])
def test_the_region_has_the_size_that_is_asked_for(times: int) -> None:
    picture = scene()
    fine = np.repeat(np.repeat(picture.rgb, times, axis=0), times, axis=1)
    found = refine(blurred(CROWN, TRUNK), picture, fine)
    assert found.shape == fine.shape[:2]
    assert found.dtype == bool


def test_no_belief_at_all_gives_no_tree() -> None:
    picture = scene()
    nothing = np.zeros((SIDE, SIDE, 3), np.float32)
    nothing[..., BACKGROUND] = 1
    assert refine(nothing, Picture(np.full((SIDE, SIDE, 3), 200, np.uint8)), picture.rgb).sum() == 0
