import numpy as np
import pytest
from PIL import Image

from tests.asset.bodies import wood
from treefit.asset import AssetSettings
from treefit.asset.model import model_of
from treefit.asset.pictures.turntable import turning_frame, turntable, write_turntable


@pytest.fixture(scope="module")
def gallows():
    """A post with one arm that points to the right, 2 m long."""
    plant = wood([[0, 0, 0], [0, 0, 3], [2, 0, 3]], [0.2, 0.1, 0.05], [-1, 0, 1], [0, 0, 0])
    return model_of(plant, AssetSettings(bark="black", texture_size=0))


def reach(picture):
    """Columns that the arm reaches to the left and to the right of the post."""
    dark = picture.max(axis=2) < 110
    columns = np.flatnonzero(dark[: round(0.15 * len(picture))].any(axis=0)) + 0.5 - picture.shape[1] / 2
    return columns.min(), columns.max()


def test_half_a_turn_shows_the_other_side_and_a_quarter_the_arm_from_its_end(gallows):
    frames = turntable(gallows, 4, 160)
    ahead, behind = reach(frames[0]), reach(frames[2])
    assert ahead[1] > 60
    assert behind == pytest.approx((-ahead[1], -ahead[0]), abs=2)
    assert max(map(abs, reach(frames[1]))) < 12


def test_a_plant_is_whole_at_every_angle(gallows):
    for picture in turntable(gallows, 5, 96):
        assert not (picture.max(axis=2) < 110)[:, [0, -1]].any()


def test_the_shadow_turns_with_the_plant(gallows):
    frames = np.stack(turntable(gallows, 2, 96)).astype(int)
    ground = frames[:, -24:]
    assert np.abs(ground[0] - ground[1]).max() > 10


def test_frames_are_the_same_twice(gallows):
    np.testing.assert_array_equal(turntable(gallows, 3, 64), turntable(gallows, 3, 64))


def test_the_file_is_an_endless_webp_of_all_frames_and_the_same_bytes_twice(gallows, tmp_path):
    frames = turntable(gallows, 4, 64)
    write_turntable(frames, tmp_path / "a.webp")
    write_turntable(frames, tmp_path / "b.webp")
    assert (tmp_path / "a.webp").read_bytes() == (tmp_path / "b.webp").read_bytes()
    with Image.open(tmp_path / "a.webp") as image:
        assert (image.format, image.n_frames, image.info["loop"]) == ("WEBP", 4, 0)
        assert image.size == (turning_frame(gallows, 64).width, 64)


def test_no_frames_are_refused(gallows, tmp_path):
    with pytest.raises(ValueError, match="count must be 1 or more"):
        turntable(gallows, 0)
    with pytest.raises(ValueError, match="needs one picture"):
        write_turntable([], tmp_path / "a.webp")
