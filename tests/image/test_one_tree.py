import numpy as np

from treefit.image.one_tree import one_tree


def standing(*boxes: tuple[int, int, int, int]) -> np.ndarray:
    """(200, 300) bool: rectangles top, left, bottom, right."""
    tree = np.zeros((200, 300), bool)
    for top, left, bottom, right in boxes:
        tree[top:bottom, left:right] = True
    return tree


MIDDLE, SIDE = (20, 100, 180, 200), (20, 220, 180, 300)


def test_of_two_trees_the_one_in_the_middle_is_taken() -> None:
    np.testing.assert_array_equal(one_tree(standing(MIDDLE, SIDE)), standing(MIDDLE))


def test_a_larger_tree_at_the_side_does_not_count_more() -> None:
    slim, wide = (60, 140, 180, 170), (20, 230, 180, 300)
    np.testing.assert_array_equal(one_tree(standing(slim, wide)), standing(slim))


def test_a_tuft_close_by_belongs_to_the_tree() -> None:
    tuft = (15, 130, 18, 150)
    np.testing.assert_array_equal(one_tree(standing(MIDDLE, tuft, SIDE)), standing(MIDDLE, tuft))


def test_a_tuft_far_off_does_not() -> None:
    np.testing.assert_array_equal(
        one_tree(standing((60, 100, 180, 200), (10, 130, 14, 150))), standing((60, 100, 180, 200))
    )


def test_parts_that_touch_at_a_corner_are_one() -> None:
    corner = standing((20, 100, 100, 150), (100, 150, 180, 200))
    np.testing.assert_array_equal(one_tree(corner), corner)


def test_no_tree_stays_none() -> None:
    assert not one_tree(standing()).any()
