from __future__ import annotations

import numpy as np
import pytest

from tests.conftest import blob
from treefit.placing import place
from treefit.view import Frame, frame_for, sample


def test_a_tree_is_found_by_its_trunk_base() -> None:
    mask = np.zeros((300, 400), np.uint8)
    mask[50:178, 100:228] = blob(128, 128)
    at = place(mask)
    assert (at.top, at.bottom) == (50, 178)
    assert at.base == pytest.approx(164, abs=0.5)


def test_sampling_at_its_own_size_gives_the_same_mask() -> None:
    mask = blob(128, 128)
    assert (sample(mask, Frame(128, 2)) == mask).all()


def test_size_and_place_of_the_tree_in_the_picture_do_not_matter() -> None:
    small, large = np.zeros((200, 300), np.uint8), np.zeros((900, 700), np.uint8)
    small[40:168, 20:148], large[100:612, 60:572] = blob(128, 128), blob(512, 512)
    one, two = sample(small, Frame(64, 1)), sample(large, Frame(64, 1))
    assert (one != two).mean() < 0.01


def test_the_frame_leaves_room_for_wider_plants() -> None:
    frame = frame_for(blob(128, 192, crown=0.7), 128)
    assert frame.half_width >= 1.05
    assert frame.finer(256).half_width >= frame.half_width


def test_an_empty_mask_is_refused() -> None:
    with pytest.raises(ValueError, match="no tree in it"):
        place(np.zeros((10, 10), np.uint8))
