from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

from tests.image.scene import SIZE, scene
from treefit.image.help_odds import NOT_TREE
from treefit.image.help_strokes import read_strokes
from treefit.image.picture import Picture
from treefit.image.read import PictureError
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE

LINES = {FOLIAGE: [(60, 90), (140, 130)], BRANCH: [(100, 200), (100, 250)], NOT_TREE: [(20, 20), (340, 20)]}
PAINT = {FOLIAGE: (0, 160, 0), BRANCH: (139, 69, 19), NOT_TREE: (255, 0, 0)}


def draw(ground: Image.Image, width: int = 6, paint: dict[int, tuple[int, int, int]] = PAINT) -> Image.Image:
    scale = ground.width / SIZE[0]
    for kind, line in LINES.items():
        points = [(x * scale, y * scale) for x, y in line]
        ImageDraw.Draw(ground).line(points, fill=paint[kind], width=round(width * scale))
    return ground


def copy(scale: float = 1.0) -> Image.Image:
    return Image.fromarray(scene().rgb).resize((round(SIZE[0] * scale), round(SIZE[1] * scale)))


def check(path: Path, tolerance: float) -> None:
    """The strokes are found where they are, and nowhere else."""
    expected = np.zeros((SIZE[1], SIZE[0]), np.uint8)
    for kind, line in LINES.items():
        image = Image.new("L", SIZE)
        ImageDraw.Draw(image).line(line, fill=1, width=6)
        expected[np.asarray(image) == 1] = kind
    strokes = read_strokes(path, scene())
    assert strokes.outline is None
    for kind in LINES:
        union = (strokes.marks == kind) | (expected == kind)
        assert ((strokes.marks == kind) & (expected == kind)).sum() / union.sum() > tolerance, kind


@pytest.mark.parametrize("ground", ["copy", "white", "clear"])
def test_strokes_are_found_on_a_copy_and_on_plain_ground(tmp_path: Path, ground: str) -> None:
    image = {"copy": copy(), "white": Image.new("RGB", SIZE, "white"), "clear": Image.new("RGBA", SIZE, (0, 0, 0, 0))}
    draw(image[ground]).save(tmp_path / "hint.png")
    check(tmp_path / "hint.png", 0.95)


@pytest.mark.parametrize(("scale", "quality"), [(1.0, 85), (2.0, 85), (1.0, 60)])
def test_strokes_survive_jpeg_and_another_size(tmp_path: Path, scale: float, quality: int) -> None:
    draw(copy(scale)).save(tmp_path / "hint.jpg", quality=quality)
    check(tmp_path / "hint.jpg", 0.2)


@pytest.mark.parametrize(
    "paint",
    [
        {FOLIAGE: (0, 255, 0), BRANCH: (150, 75, 0), NOT_TREE: (237, 28, 36)},
        {FOLIAGE: (34, 177, 76), BRANCH: (185, 122, 87), NOT_TREE: (200, 0, 0)},
        {FOLIAGE: (0, 128, 0), BRANCH: (165, 42, 42), NOT_TREE: (220, 20, 60)},
        {FOLIAGE: (76, 153, 60), BRANCH: (121, 85, 61), NOT_TREE: (255, 0, 0)},
    ],
)
def test_any_usual_green_brown_and_red_will_do(tmp_path: Path, paint: dict[int, tuple[int, int, int]]) -> None:
    draw(Image.new("RGB", SIZE, "white"), paint=paint).save(tmp_path / "hint.png")
    check(tmp_path / "hint.png", 0.95)


def test_colours_of_the_picture_itself_are_no_strokes(tmp_path: Path) -> None:
    own = Picture(np.asarray(draw(copy())))
    image = Image.fromarray(own.rgb)
    ImageDraw.Draw(image).line([(300, 100), (340, 120)], fill=(255, 0, 0), width=6)
    image.save(tmp_path / "hint.png")
    marks = read_strokes(tmp_path / "hint.png", own).marks
    assert set(np.unique(marks)) == {BACKGROUND, NOT_TREE}
    assert np.nonzero(marks)[1].min() > 290


def test_closed_lines_enclose_and_small_loops_of_a_scribble_do_not(tmp_path: Path) -> None:
    image = copy()
    pen = ImageDraw.Draw(image)
    pen.ellipse((40, 40, 160, 180), outline=(0, 160, 0), width=4)
    pen.ellipse((220, 60, 300, 140), outline=(255, 0, 0), width=4)
    pen.ellipse((320, 200, 335, 215), outline=(139, 69, 19), width=4)
    image.save(tmp_path / "hint.png")
    strokes = read_strokes(tmp_path / "hint.png", scene())
    assert strokes.outline is not None
    assert strokes.outline[110, 100]
    assert not strokes.outline[110, 260]
    assert strokes.marks[100, 260] == NOT_TREE
    assert strokes.marks[110, 100] == strokes.marks[207, 327] == BACKGROUND


@pytest.mark.parametrize(("suffix", "quality"), [("png", 0), ("jpg", 90), ("jpg", 70)])
def test_a_hint_without_strokes_is_refused(tmp_path: Path, suffix: str, quality: int) -> None:
    copy().save(tmp_path / f"hint.{suffix}", **({"quality": quality} if quality else {}))
    with pytest.raises(PictureError, match=r"is the picture itself, nothing is painted on it; paint the tree green"):
        read_strokes(tmp_path / f"hint.{suffix}", scene())


def test_strokes_of_other_colours_are_refused(tmp_path: Path) -> None:
    image = copy()
    ImageDraw.Draw(image).line([(10, 10), (300, 200)], fill=(0, 0, 255), width=6)
    image.save(tmp_path / "hint.png")
    with pytest.raises(PictureError, match="has no strokes in the right colours; paint the tree green"):
        read_strokes(tmp_path / "hint.png", scene())


def test_another_picture_is_no_hint(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    Image.fromarray(rng.integers(0, 90, (300, 360, 3), dtype=np.uint8)).save(tmp_path / "other.png")
    with pytest.raises(PictureError, match=r"other\.png: the hint is no copy of the picture, nor strokes on white"):
        read_strokes(tmp_path / "other.png", scene())


def test_a_hint_of_another_shape_is_refused(tmp_path: Path) -> None:
    copy().resize((300, 300)).save(tmp_path / "hint.png")
    with pytest.raises(PictureError, match="the hint is 300 x 300 pixels and the picture 360 x 300"):
        read_strokes(tmp_path / "hint.png", scene())
