from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

from tests.image.scene import LEFT, RIGHT, overlap, scene, truth
from treefit.image import ColourMask, Extraction, Help, HelpedMask, Picture, PictureError
from treefit.image.read import NoTreeError
from treefit.image.resize import resize_mask
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, Mask

OUTLINE = (
    (100, 33),
    (145, 48),
    (168, 95),
    (160, 165),
    (120, 200),
    (112, 265),
    (88, 265),
    (80, 200),
    (38, 165),
    (32, 95),
    (55, 48),
)


@dataclass(frozen=True)
class Sees:
    """Extractor that finds what it is told to, at the size that it is shown."""

    mask: Mask | None

    def __call__(self, picture: Picture) -> Extraction:
        if self.mask is None:
            raise NoTreeError("no tree was found")
        return Extraction(resize_mask(self.mask, picture.shape), "sees", 0.3, "it was told so")


def test_only_the_crop_is_looked_at_and_the_mask_is_of_the_whole_picture() -> None:
    inside = np.full((100, 80), FOLIAGE, np.uint8)
    found = HelpedMask(Sees(inside), Help(crop=(50, 20, 130, 120)))(scene())
    assert found.mask.shape == (300, 360)
    assert found.mask.sum() == inside.sum()
    assert (found.mask[20:120, 50:130] == FOLIAGE).all()
    assert found.warnings[0] == "the tree is cut off at the top and left and right of mask.crop"
    assert found.why.startswith("inside mask.crop; ")


@pytest.mark.parametrize(("point", "columns"), [((LEFT, 100), LEFT), ((RIGHT + 64, 110), RIGHT)])
def test_of_several_trees_the_one_at_or_nearest_to_the_point_is_taken(point: tuple[int, int], columns: int) -> None:
    found = HelpedMask(Sees(truth(LEFT, RIGHT)), Help(point=point))(scene())
    assert np.array_equal(found.mask, truth(columns))
    assert found.why.startswith("the part at your point; ")


@pytest.mark.parametrize("column", [LEFT, RIGHT])
def test_an_extractor_that_takes_one_tree_is_shown_the_one_at_the_point(column: int) -> None:
    found = HelpedMask(ColourMask(), Help(point=(column, 100)))(scene())
    columns = np.nonzero(found.mask)[1]
    assert abs(np.median(columns) - column) < 20


@pytest.mark.parametrize("first", [ColourMask(), Sees(None), Sees(truth(RIGHT)), Sees(truth(LEFT, RIGHT))])
def test_the_tree_inside_an_outline_is_found_whatever_the_extractor_says(first: ColourMask | Sees) -> None:
    found = HelpedMask(first, Help(outline=OUTLINE))(scene())
    assert overlap(found.mask, truth(LEFT)) > 0.9
    assert (found.mask[200:255, LEFT] == BRANCH).mean() > 0.9
    assert (found.mask[60:140, LEFT] == FOLIAGE).mean() > 0.9
    assert found.why.startswith("inside your outline; ")
    assert found.confidence == 0.9


def test_blue_low_inside_the_outline_is_water_or_sky() -> None:
    rgb = scene().rgb.copy()
    rgb[185:215, LEFT - 18 : LEFT + 18] = (40, 90, 220)
    found = HelpedMask(Sees(truth(LEFT)), Help(outline=OUTLINE))(Picture(rgb))
    assert (found.mask[190:210, LEFT - 14 : LEFT + 14] == BACKGROUND).mean() > 0.9


def test_nothing_is_tree_far_outside_the_outline() -> None:
    mask = HelpedMask(Sees(truth(LEFT, RIGHT)), Help(outline=OUTLINE))(scene()).mask
    assert not mask[:, 185:].any()


def test_sky_inside_an_outline_stays_background() -> None:
    mask = HelpedMask(Sees(None), Help(outline=((5, 5), (195, 5), (195, 165), (5, 165))))(scene()).mask
    assert not mask[5:30, 20:180].any()
    assert mask[60:140, LEFT - 30 : LEFT + 30].all()


def painted(path: Path, ground: Picture, *lines: tuple[tuple[int, int, int], list[tuple[int, int]]]) -> Path:
    image = Image.fromarray(ground.rgb)
    for colour, line in lines:
        ImageDraw.Draw(image).line(line, fill=colour, width=5)
    image.save(path)
    return path


GREEN, BROWN, RED = (0, 160, 0), (139, 69, 19), (255, 0, 0)


def test_strokes_take_off_one_tree_and_keep_the_other(tmp_path: Path) -> None:
    hint = painted(tmp_path / "hint.png", scene(), (GREEN, [(70, 90), (130, 130)]), (RED, [(225, 80), (300, 150)]),
                   (RED, [(240, 150), (290, 60)]), (RED, [(RIGHT, 180), (RIGHT, 260)]))  # fmt: skip
    mask = HelpedMask(Sees(truth(LEFT, RIGHT)), Help(hint=hint))(scene()).mask
    assert overlap(mask[:, :180], truth(LEFT)[:, :180]) > 0.9
    assert (mask[:, 200:] > 0).mean() < 0.5 * (truth(RIGHT)[:, 200:] > 0).mean()


def test_what_lies_under_a_stroke_is_as_it_says(tmp_path: Path) -> None:
    lines = [(GREEN, [(170, 30), (190, 30)]), (RED, [(80, 100), (120, 100)]), (BROWN, [(LEFT, 60), (LEFT, 80)])]
    mask = HelpedMask(Sees(truth(LEFT)), Help(hint=painted(tmp_path / "hint.png", scene(), *lines)))(scene()).mask
    assert (mask[30, 172:189] == FOLIAGE).all()
    assert not mask[100, 82:119].any()
    assert (mask[62:79, LEFT] == BRANCH).all()


def test_a_closed_green_line_is_an_outline(tmp_path: Path) -> None:
    hint = painted(tmp_path / "hint.png", scene(), (GREEN, [*OUTLINE, OUTLINE[0]]))
    found = HelpedMask(Sees(truth(LEFT, RIGHT)), Help(hint=hint))(scene())
    assert overlap(found.mask, truth(LEFT)) > 0.85
    assert found.why.startswith("inside your outline and by your strokes; ")


def test_an_outline_outside_the_crop_is_refused() -> None:
    with pytest.raises(PictureError, match=r"mask\.outline: is outside mask\.crop"):
        HelpedMask(ColourMask(), Help(outline=OUTLINE, crop=(200, 0, 360, 300)))(scene())


@pytest.mark.slow
def test_the_same_help_gives_the_same_bytes(tmp_path: Path) -> None:
    hint = painted(tmp_path / "hint.png", scene(), (GREEN, [(70, 90), (130, 130)]))
    extractor = HelpedMask(ColourMask(), Help(outline=OUTLINE, hint=hint, point=(LEFT, 100)))
    assert extractor(scene()).mask.tobytes() == extractor(scene()).mask.tobytes()
