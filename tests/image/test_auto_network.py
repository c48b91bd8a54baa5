"""AutoMask with a network that knows one colour: what it chooses, how sure it is and what it says."""

import sys
from pathlib import Path

import numpy as np
import pytest

from tests.image.scene import LEFT, scene
from tests.image.test_extractors import class_agreement, lollipop, picture
from tests.image.tiny_onnx import write_model
from treefit.image.auto import AutoMask
from treefit.image.extraction import Extraction
from treefit.image.network import NetworkMask
from treefit.image.onnx_model import ModelError
from treefit.image.picture import Picture
from treefit.image.proposals import best_of
from treefit.image.read import NoTreeError
from treefit.image.sketch import SketchMask
from treefit.mask import BACKGROUND

INK = ((0, 0, 0), (30, -30, -30), (-10, 20, -10))
"""Logits of background, branch, foliage: for green foliage, red branch."""


def auto(path: Path, weights: object, **settings: float) -> AutoMask:
    return AutoMask(network=NetworkMask(model=write_model(path / "net.onnx", weights)), **settings)


def test_a_photograph_is_left_to_the_network(tmp_path: Path) -> None:
    found = auto(tmp_path, ((9, 9, 9), (-99, -99, -99), (-90, 150, -90)))(scene())
    assert found.method == "network"
    assert found.why.startswith("a photograph; a network found it")


def test_an_unsure_network_is_a_warning_with_the_cure(tmp_path: Path) -> None:
    unsure = ((0, 0, 0), (-9, -9, -9), (0, 0.3, 0))
    found = auto(tmp_path, unsure)(scene())
    assert found.confidence < 0.7
    assert found.warnings[0].startswith(f"unsure of the tree ({found.confidence:.0%}): look at mask_overlay.png")
    assert "mask.point=[x,y]" in found.warnings[0]
    assert "unsure" not in " ".join(auto(tmp_path, unsure, sure=0.0)(scene()).warnings)


def test_a_drawing_is_cut_out_along_its_edges_when_the_network_agrees(tmp_path: Path) -> None:
    drawing = picture(lollipop(crown=(0, 200, 0), trunk=(200, 0, 0), ground=(235, 240, 250)))
    found = auto(tmp_path, ((8, 8, 8), (60, -60, -60), (-60, 60, -60)))(drawing)
    assert found.method == "colour"
    assert found.why.startswith("a plain ground; ")
    assert class_agreement(found.mask) > 0.95


def test_a_drawing_is_cut_out_by_the_network_when_it_sees_another_tree(tmp_path: Path) -> None:
    green_only = picture(lollipop(crown=(0, 200, 0), trunk=(0, 0, 200), ground=(235, 240, 250)))
    found = auto(tmp_path, ((8, 8, 8), (60, -60, -60), (-60, 60, -60)))(green_only)
    assert found.method == "network"
    assert (found.mask[300, 140:160] == BACKGROUND).all()


def test_ways_that_find_no_tree_are_passed_over(tmp_path: Path) -> None:
    class Blind(SketchMask):
        def __call__(self, picture: Picture) -> Extraction:
            raise NoTreeError(f"no tree in {picture.shape}")

    drawing = picture(lollipop(crown=(0, 200, 0), trunk=(200, 0, 0), ground=(235, 240, 250)))
    network = auto(tmp_path, ((8, 8, 8), (60, -60, -60), (-60, 60, -60))).network
    assert best_of(drawing, [Blind()], network).method == "network"
    none = NetworkMask(model=write_model(tmp_path / "none.onnx", ((9, 9, 9), (-9, -9, -9), (-9, -9, -9))))
    with pytest.raises(NoTreeError):
        best_of(drawing, [Blind()], none)


def test_without_onnxruntime_colours_have_to_do(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "onnxruntime", None)
    found = auto(tmp_path, INK)(scene())
    assert found.method == "colour"
    assert found.warnings[0] == (
        "a mask network needs onnxruntime: python -m pip install onnxruntime; until then colours have to do"
    )


def test_a_model_of_the_users_that_cannot_be_run_is_no_reason_for_colours(tmp_path: Path) -> None:
    path = tmp_path / "none.onnx"
    with pytest.raises(ModelError, match=r"none\.onnx: no such model file"):
        AutoMask(network=NetworkMask(model=path))(scene())


def test_the_network_that_comes_with_the_program_finds_the_tree_in_the_middle() -> None:
    rgb = np.ascontiguousarray(scene().rgb[:, : 2 * LEFT])
    found = AutoMask()(Picture(rgb))
    assert found.method == "network"
    assert found.mask[100, LEFT] != BACKGROUND
    assert (found.mask[:20] == BACKGROUND).all()


@pytest.mark.parametrize("shape", [(8, 8), (9, 64), (64, 9), (64, 64), (100, 333)])
@pytest.mark.parametrize("kind", ["noise", "smooth"])
def test_a_picture_of_no_tree_is_refused_or_unsure(shape: tuple[int, int], kind: str) -> None:
    rgb = np.random.default_rng(0).integers(0, 256, (*shape, 3)).astype(np.uint8)
    if kind == "smooth":
        rgb = (
            np.repeat(np.linspace(0, 255, shape[0])[:, None, None], shape[1], axis=1).repeat(3, axis=2).astype(np.uint8)
        )
    try:
        found = AutoMask()(Picture(rgb))
    except NoTreeError:
        return
    assert found.warnings[0].startswith("unsure of the tree")
