import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from PIL import Image, ImageDraw

from treefit.image.belief import Belief
from treefit.image.kinds import is_leafless, kinds
from treefit.image.picture import Region, Rgb
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, Mask

SIZE = (120, 160)
"""Width and height of what is drawn."""
SKY, BARK, LEAF = (150, 190, 235), (105, 75, 50), (55, 125, 40)
CROWN, TRUNK = (15, 10, 105, 90), (54, 80, 66, 150)


def drawn(*shapes: tuple[str, tuple[int, ...], int]) -> Mask:
    """Mask of `shapes`: rectangle, ellipse or line, where, and which kind; the later ones on top."""
    image = Image.new("L", SIZE)
    for shape, place, kind in shapes:
        getattr(ImageDraw.Draw(image), shape)(place, fill=kind)
    return np.asarray(image)


def painted(mask: Mask) -> Rgb:
    return np.array([SKY, BARK, LEAF], np.uint8)[mask]


def believed(mask: Mask, sureness: float = 0.9) -> Belief:
    """Belief of one who sees `mask`; the rest goes to the two other kinds alike."""
    return np.eye(3, dtype=np.float32)[mask] * (1.5 * sureness - 0.5) + np.float32((1 - sureness) / 2)


def lollipop() -> Mask:
    return drawn(("rectangle", TRUNK, BRANCH), ("ellipse", CROWN, FOLIAGE))


def winter_tree() -> Mask:
    """A trunk with strokes in all directions, 1 to 3 pixels wide."""
    image = Image.new("L", SIZE)
    draw = ImageDraw.Draw(image)
    draw.line((60, 150, 60, 30), fill=BRANCH, width=5)
    for step in range(10):
        y = 110 - 9 * step
        for side in (-1, 1):
            tip = (60 + side * (45 - 3 * step), y - 28)
            draw.line((60, y, *tip), fill=BRANCH, width=3)
            draw.line((60 + side * 15, y - 9, tip[0], tip[1] + 16), fill=BRANCH, width=1)
    return np.asarray(image)


def test_a_sure_belief_is_kept() -> None:
    tree = lollipop()
    found = kinds(painted(tree), tree > 0, believed(tree))
    assert (found == tree).mean() > 0.995


def test_colour_gives_the_wood_that_the_network_was_in_doubt_about() -> None:
    tree = lollipop()
    belief = believed(tree)
    doubtful = np.s_[100:120, 54:67]
    belief[doubtful] = (0.1, 0.35, 0.55)
    found = kinds(painted(tree), tree > 0, belief)
    assert (found[doubtful] == BRANCH).all()


def test_a_pale_gap_in_the_trunk_is_filled() -> None:
    tree = lollipop()
    gap = np.s_[118:126, 54:67]
    rgb, belief = painted(tree), believed(tree)
    rgb[gap], belief[gap] = (235, 225, 200), (0.3, 0.02, 0.68)
    assert (kinds(rgb, tree > 0, belief)[gap] == BRANCH).all()


def test_a_low_crown_is_not_taken_for_a_gap() -> None:
    tree = drawn(("rectangle", (56, 80, 64, 150), BRANCH), ("ellipse", (15, 10, 105, 130), FOLIAGE))
    found = kinds(painted(tree), tree > 0, believed(tree))
    assert (found[:125][tree[:125] > 0] == FOLIAGE).all()


def test_a_speck_in_the_crown_becomes_foliage_and_a_limb_stays() -> None:
    tree = lollipop()
    rgb, speck, limb = painted(tree), np.s_[40:42, 30:32], np.s_[45:70, 75:80]
    belief = believed(tree)
    for place in (speck, limb):
        belief[place] = (0.1, 0.5, 0.4)
    rgb[limb] = BARK
    found = kinds(rgb, tree > 0, belief)
    assert (found[speck] == FOLIAGE).all()
    assert (found[limb] == BRANCH).mean() > 0.9


@pytest.mark.parametrize("sky", [SKY, (245, 245, 245), (40, 30, 60)])
def test_a_lacy_tree_without_leaf_colours_is_all_branch_though_the_network_doubts(sky: tuple[int, int, int]) -> None:
    tree = winter_tree()
    belief = np.full((*tree.shape, 3), (0.2, 0.25, 0.55), np.float32)
    rgb = painted(tree)
    rgb[tree == BACKGROUND] = sky
    found = kinds(rgb, tree > 0, belief)
    np.testing.assert_array_equal(found, np.where(tree > 0, BRANCH, BACKGROUND))


def test_the_same_doubt_in_a_closed_or_green_crown_is_foliage() -> None:
    closed, lacy = lollipop(), winter_tree()
    green = np.where(lacy > 0, FOLIAGE, BACKGROUND).astype(np.uint8)
    for tree in (closed, green):
        belief = np.full((*tree.shape, 3), (0.2, 0.2, 0.6), np.float32)
        assert not is_leafless(painted(tree), tree > 0, belief)


def test_a_lacy_dark_tree_stays_leafy_when_the_network_is_sure_of_its_leaves() -> None:
    lacy = winter_tree()
    fronds = (lacy > 0) & (np.arange(len(lacy)) < 80)[:, None]
    palm = np.where(fronds, FOLIAGE, lacy).astype(np.uint8)
    assert not is_leafless(np.full((*palm.shape, 3), 20, np.uint8), palm > 0, believed(palm, 0.98))


def test_a_tree_without_a_trunk_is_all_foliage() -> None:
    bush = drawn(("ellipse", CROWN, FOLIAGE))
    np.testing.assert_array_equal(kinds(painted(bush), bush > 0, believed(bush)), bush)


@pytest.mark.parametrize("kind", [BRANCH, FOLIAGE])
def test_a_tree_of_one_pixel_is_what_the_network_says(kind: int) -> None:
    dot = np.zeros((9, 7), np.uint8)
    dot[4, 3] = kind
    rgb = np.full((9, 7, 3), 90, np.uint8)
    np.testing.assert_array_equal(kinds(rgb, dot > 0, believed(dot)), dot)


def test_no_tree_gives_no_mask() -> None:
    nothing = np.zeros((5, 6), np.uint8)
    assert not kinds(painted(nothing), nothing > 0, believed(nothing)).any()


def test_other_sizes_are_refused() -> None:
    tree = lollipop()
    with pytest.raises(ValueError, match=r"kinds: picture \(160, 120, 3\).* must have one size"):
        kinds(painted(tree), tree[1:] > 0, believed(tree))


@st.composite
def cases(draw: st.DrawFn) -> tuple[Rgb, Region, Belief]:
    shape = (draw(st.integers(1, 24)), draw(st.integers(1, 24)))
    tree = draw(arrays(bool, shape))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    belief = rng.dirichlet(draw(st.sampled_from([(1, 1, 1), (0.01, 0.01, 0.01), (9, 0.1, 0.1)])), shape)
    return rng.integers(0, 256, (*shape, 3), np.uint8), tree, np.nan_to_num(belief).astype(np.float32)


@settings(deadline=None, max_examples=60)
@given(cases())
def test_kinds_change_and_the_region_never(case: tuple[Rgb, Region, Belief]) -> None:
    rgb, tree, belief = case
    given_belief = belief.copy()
    found = kinds(rgb, tree, belief)
    np.testing.assert_array_equal(found != BACKGROUND, tree)
    assert found.dtype == np.uint8
    assert found.max(initial=0) <= FOLIAGE
    np.testing.assert_array_equal(belief, given_belief)
