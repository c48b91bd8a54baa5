import pickle
from pathlib import Path

import numpy as np
import pytest
from pydantic import ValidationError

from tests.image.test_extractors import lollipop, picture, truth
from tests.image.tiny_onnx import HALF, Side, write_model
from treefit.image.network import NetworkMask
from treefit.image.onnx_model import ModelError
from treefit.image.picture import Picture
from treefit.image.read import PictureError
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE

pytest.importorskip("onnxruntime", reason="onnxruntime is not installed: no network can be run")

WEIGHTS = ((0, 0, 40), (20, -20, 0), (-20, 20, 0))
"""Logits of background, branch, foliage for a red trunk and a green crown before blue."""
COLOURS = {"crown": (0, 255, 0), "trunk": (255, 0, 0), "ground": (0, 0, 255)}
SCENE = picture(lollipop(**COLOURS))


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return write_model(tmp_path / "colours.onnx", WEIGHTS)


def overlap(found: np.ndarray, expected: np.ndarray) -> float:
    return float((found & expected).sum() / (found | expected).sum())


def test_each_channel_becomes_its_class_at_the_size_of_the_picture(model: Path) -> None:
    found = NetworkMask(model=model)(SCENE)
    assert found.method == "network"
    assert found.confidence > 0.95
    for kind in (BACKGROUND, BRANCH, FOLIAGE):
        assert overlap(found.mask == kind, truth() == kind) > 0.95


def test_belief_is_a_probability_at_the_size_of_the_network(model: Path) -> None:
    belief = NetworkMask(model=model, size=128).belief(SCENE)
    assert belief.shape == (128, 128, 3)  # 300 x 400: sides are multiples of 64
    assert belief.dtype == np.float32
    assert belief.min() >= 0
    np.testing.assert_allclose(belief.sum(axis=2), 1, atol=1e-5)


def test_the_same_picture_gives_the_same_bytes(model: Path) -> None:
    extractor = NetworkMask(model=model)
    np.testing.assert_array_equal(extractor.belief(SCENE), pickle.loads(pickle.dumps(extractor)).belief(SCENE))


def test_logits_and_probabilities_are_told_apart(model: Path, tmp_path: Path) -> None:
    soft = write_model(tmp_path / "soft.onnx", WEIGHTS, last="Softmax")
    logits, shares = NetworkMask(model=model).belief(SCENE), NetworkMask(model=soft).belief(SCENE)
    np.testing.assert_allclose(logits, shares, atol=1e-5)


def test_channels_may_have_another_order_and_more_names(tmp_path: Path) -> None:
    other = write_model(tmp_path / "other.onnx", (WEIGHTS[2], WEIGHTS[0], (-99, -99, -99), WEIGHTS[1]))
    extractor = NetworkMask(model=other, classes=("foliage", "background", "background", "branch"))
    found = extractor(SCENE).mask
    assert overlap(found == BRANCH, truth() == BRANCH) > 0.95
    assert overlap(found == FOLIAGE, truth() == FOLIAGE) > 0.95


@pytest.mark.parametrize("last", ["Identity", "Sigmoid"])
def test_one_channel_of_tree_is_split_by_shape(tmp_path: Path, last: str) -> None:
    salient = write_model(tmp_path / "salient.onnx", ((20, 20, -40),), last=last)
    found = NetworkMask(model=salient, classes=("tree",))(SCENE).mask
    assert overlap(found != BACKGROUND, truth() != BACKGROUND) > 0.95
    assert overlap(found == BRANCH, truth() == BRANCH) > 0.7


def test_mean_and_std_are_applied_to_pixels_in_0_to_1(tmp_path: Path) -> None:
    raw = write_model(tmp_path / "raw.onnx", np.array(WEIGHTS) / 255)
    found = NetworkMask(model=raw, std=(1 / 255, 1 / 255, 1 / 255))(SCENE).mask
    assert overlap(found == FOLIAGE, truth() == FOLIAGE) > 0.95
    shifted = NetworkMask(model=raw, mean=(0, 0, 2), std=(1 / 255, 1 / 255, 1 / 255)).belief(SCENE)
    assert shifted[..., BACKGROUND].max() < 1e-9


def test_a_model_of_one_size_gets_pictures_of_that_size(tmp_path: Path) -> None:
    fixed = write_model(tmp_path / "fixed.onnx", WEIGHTS, sides=(1, 3, 96, 80))
    extractor = NetworkMask(model=fixed)
    assert extractor.belief(SCENE).shape == (96, 80, 3)
    assert extractor(SCENE).mask.shape == SCENE.shape


def test_half_precision_models_are_run(tmp_path: Path) -> None:
    half = write_model(tmp_path / "half.onnx", WEIGHTS, number=HALF)
    assert overlap(NetworkMask(model=half)(SCENE).mask == FOLIAGE, truth() == FOLIAGE) > 0.95


def test_a_file_written_anew_is_loaded_anew(model: Path) -> None:
    extractor = NetworkMask(model=model)
    before = extractor.belief(SCENE)
    write_model(model, (WEIGHTS[0], WEIGHTS[2], WEIGHTS[1]), last="Softmax")
    np.testing.assert_allclose(before[..., [0, 2, 1]], extractor.belief(SCENE), atol=1e-5)


def test_a_missing_model_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=r"none\.onnx: no such model file; give an ONNX file$"):
        NetworkMask(model=tmp_path / "none.onnx")(SCENE)


def test_another_file_is_no_model(tmp_path: Path) -> None:
    path = tmp_path / "picture.onnx"
    path.write_bytes(b"\x89PNG and so on")
    with pytest.raises(ModelError, match="not an ONNX file that can be run") as caught:
        NetworkMask(model=path)(SCENE)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("sides", [(1, 3, "h"), (1, 1, "h", "w"), (1, "h", "w", 4)])
def test_a_model_of_other_inputs_is_refused(tmp_path: Path, sides: tuple[Side, ...]) -> None:
    path = write_model(tmp_path / "other.onnx", WEIGHTS, sides=sides)
    with pytest.raises(ModelError, match=r"other\.onnx: .*"):
        NetworkMask(model=path)(SCENE)


def test_the_number_of_channels_must_be_that_of_the_names(model: Path) -> None:
    with pytest.raises(ModelError, match=r"gives 3 channels, and mask\.classes names 2: background, tree; name each"):
        NetworkMask(model=model, classes=("background", "tree"))(SCENE)


def test_an_answer_that_is_not_finite_is_refused(tmp_path: Path) -> None:
    path = write_model(tmp_path / "nan.onnx", np.full((3, 3), np.nan))
    with pytest.raises(ModelError, match="its output is not finite"):
        NetworkMask(model=path)(SCENE)


def test_a_picture_without_tree_is_said_to_have_none(model: Path) -> None:
    blue = picture(lollipop(crown=(0, 0, 250), trunk=(0, 0, 240), ground=(0, 0, 255)))
    with pytest.raises(PictureError, match="no tree was found"):
        NetworkMask(model=model)(blue)


def test_classes_must_name_the_tree_and_its_background() -> None:
    with pytest.raises(ValidationError, match="classes must name what is tree"):
        NetworkMask(classes=("background",))
    with pytest.raises(ValidationError, match="classes must name the channel of the background"):
        NetworkMask(classes=("branch", "foliage"))
    with pytest.raises(ValidationError, match="'background', 'branch', 'foliage' or 'tree'"):
        NetworkMask(classes=("sky", "tree"))


@pytest.mark.parametrize("shape", [(8, 3000), (3000, 8)])
def test_very_long_pictures_are_read(model: Path, shape: tuple[int, int]) -> None:
    rgb = np.zeros((*shape, 3), np.uint8)
    rgb[..., 2] = 255
    rgb[2:6, 2:6] = (0, 255, 0)
    extractor = NetworkMask(model=model, threshold=0.01)
    assert extractor.belief(Picture(rgb)).shape[:2] == tuple(64 if side == 8 else 256 for side in shape)


def outdoors() -> Picture:
    """Smooth sky over rough ground."""
    rgb = np.full((128, 128, 3), (150, 185, 240), np.uint8)
    rgb[80:] = np.random.default_rng(0).integers(20, 120, (48, 128, 3))
    return Picture(rgb)


def test_the_sky_needs_to_be_surer_to_be_tree(tmp_path: Path) -> None:
    unsure = write_model(tmp_path / "unsure.onnx", ((0, 0, 0), (-9, -9, -9), (0, 0, 0.9)))  # 0.7 in the sky
    found, kept = (NetworkMask(model=unsure, sky=sky, clean=False)(outdoors()).mask for sky in (0.95, 0.5))
    assert (found[5:70] == BACKGROUND).all()
    assert (kept[5:70] == FOLIAGE).all()


def test_cleaning_takes_the_sky_from_an_unsure_answer(tmp_path: Path) -> None:
    unsure = write_model(tmp_path / "unsure.onnx", ((0, 0, 0), (-9, -9, -9), (0, 0, 0.9)))
    assert (NetworkMask(model=unsure)(outdoors()).mask[5:70] == BACKGROUND).all()


def test_the_paper_of_a_drawing_is_no_sky(tmp_path: Path) -> None:
    unsure = write_model(tmp_path / "unsure.onnx", ((0, 0, 0), (-9, -9, -9), (0, 0, 0.9)))
    drawing = outdoors().rgb.copy()
    drawing[80:, :8] = drawing[80:, -8:] = (150, 185, 240)
    assert (NetworkMask(model=unsure)(Picture(drawing)).mask[5:70] == FOLIAGE).all()
