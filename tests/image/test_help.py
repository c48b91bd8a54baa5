import re

import numpy as np
import pytest
from pydantic import ValidationError

from treefit.image.help import Help
from treefit.image.read import PictureError

SHAPE = (200, 400)
TRIANGLE = ((40, 20), (360, 20), (200, 180))


def test_shares_and_pixels_say_the_same() -> None:
    assert Help(crop=(0.1, 0.1, 0.9, 0.9)).window(SHAPE) == Help(crop=(40, 20, 360, 180)).window(SHAPE)
    assert Help(point=(0.5, 0.25)).pixel(SHAPE) == Help(point=(200, 50)).pixel(SHAPE) == (50, 200)
    shares = Help(outline=((0.1, 0.1), (0.9, 0.1), (0.5, 0.9))).polygon(SHAPE)
    np.testing.assert_allclose(shares, Help(outline=TRIANGLE).polygon(SHAPE))


def test_one_number_over_1_makes_all_of_them_pixels() -> None:
    assert Help(crop=(0, 1, 20, 200)).window(SHAPE) == (slice(1, 200), slice(0, 20))


def test_without_help_there_is_nothing_to_see() -> None:
    assert (Help().window(SHAPE), Help().pixel(SHAPE), Help().polygon(SHAPE)) == (
        (slice(0, 200), slice(0, 400)),
        None,
        None,
    )
    assert not Help()
    assert Help(point=(0, 0))


def test_a_rough_hand_may_leave_the_picture_a_little() -> None:
    polygon = Help(outline=((-8, -5), (408, 20), (200, 205))).polygon(SHAPE)
    assert polygon is not None
    assert polygon.min() == 0
    assert tuple(polygon.max(axis=0)) == (400, 200)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"crop": (0, 0, 5)}, "must be [left, top, right, bottom], all of them numbers; got (0, 0, 5)"),
        ({"crop": (9, 0, 5, 5)}, "left under right, top under bottom; got [9, 0, 5, 5]"),
        ({"crop": (0, 0, float("inf"), 5)}, "finite"),
        ({"point": 3}, "must be [x, y], all of them numbers; got 3"),
        ({"point": (-1, 5)}, "greater than or equal to 0"),
        ({"point": ("a", 5)}, "must be [x, y]"),
        ({"outline": ((1, 2), (3, 4))}, "at least 3 different points [x, y], got 2"),
        ({"outline": ((1, 2), (1, 2), (3, 4))}, "at least 3 different points [x, y], got 2"),
        ({"outline": ((1, 2), (3, 4), (5,))}, "must be [[x, y], [x, y], ...]"),
    ],
)
def test_what_cannot_be_is_refused(given: dict[str, object], message: str) -> None:
    with pytest.raises(ValidationError, match=re.escape(message)):
        Help(**given)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("help_", "message"),
    [
        (Help(crop=(0, 0, 401, 100)), "mask.crop: [0, 0, 401, 100] reaches out of the picture of 400 x 200 pixels"),
        (Help(crop=(0, 0, 5, 100)), "mask.crop: [0, 0, 5, 100] leaves 5 x 100 pixels of the picture of 400 x 200"),
        (Help(point=(50, 201)), "mask.point: [50, 201] is outside the picture of 400 x 200 pixels"),
        (Help(point=(50, 50), crop=(60, 0, 400, 200)), "mask.point: [50, 50] is outside mask.crop [60, 0, 400, 200]"),
        (
            Help(outline=((1, 1), (500, 1), (1, 90))),
            "mask.outline: [500, 1] is outside the picture of 400 x 200 pixels",
        ),
        (Help(outline=((2, 2), (20, 20), (40, 40))), "mask.outline: encloses next to nothing of the picture"),
    ],
)
def test_what_does_not_suit_the_picture_is_one_line(help_: Help, message: str) -> None:
    with pytest.raises(PictureError, match=re.escape(message)):
        (help_.window(SHAPE), help_.pixel(SHAPE), help_.polygon(SHAPE))
