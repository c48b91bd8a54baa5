import math

import numpy as np
import pytest
from PIL import Image, ImageDraw
from pydantic import ValidationError

from treefit.image.alpha import AlphaMask
from treefit.image.auto import AutoMask
from treefit.image.colour import ColourMask
from treefit.image.picture import Picture
from treefit.image.read import PictureError
from treefit.image.sketch import SketchMask
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE

CROWN, TRUNK = (60, 20, 240, 220), (135, 200, 165, 380)
GREEN, BROWN, GREY = (40, 150, 50), (110, 70, 40), (120, 120, 120)


def lollipop(
    crown: object = GREEN, trunk: object = BROWN, outline: object = None, ground: object = "white"
) -> Image.Image:
    image = Image.new("RGB", (300, 400), ground)
    draw = ImageDraw.Draw(image)
    draw.rectangle(TRUNK, fill=trunk, outline=outline, width=3)
    draw.ellipse(CROWN, fill=crown, outline=outline, width=3)
    return image


def picture(image: Image.Image, alpha: np.ndarray | None = None) -> Picture:
    return Picture(np.asarray(image.convert("RGB")), alpha)


def truth() -> np.ndarray:
    image = Image.new("L", (300, 400), BACKGROUND)
    draw = ImageDraw.Draw(image)
    draw.rectangle(TRUNK, fill=BRANCH)
    draw.ellipse(CROWN, fill=FOLIAGE)
    return np.asarray(image)


def class_agreement(mask: np.ndarray) -> float:
    """Worst intersection over union of the three classes."""
    expected = truth()
    return min(
        float(((mask == k) & (expected == k)).sum() / ((mask == k) | (expected == k)).sum())
        for k in (BACKGROUND, BRANCH, FOLIAGE)
    )


def opaque(image: Image.Image) -> np.ndarray:
    return np.where((np.asarray(image) == 255).all(axis=2), 0, 255).astype(np.uint8)


def test_a_flat_cutout_is_split_by_hue() -> None:
    image = lollipop()
    found = AutoMask()(picture(image, opaque(image)))
    assert found.method == "alpha"
    assert class_agreement(found.mask) > 0.97
    assert found.warnings == ()


def test_a_grey_shadow_disc_is_not_tree() -> None:
    image = Image.new("RGB", (300, 400), "white")
    ImageDraw.Draw(image).ellipse((60, 350, 240, 398), fill=GREY)
    image.paste(lollipop(), (0, 0), Image.fromarray(opaque(lollipop())))
    found = AlphaMask()(picture(image, opaque(image)))
    assert class_agreement(found.mask) > 0.93


def test_a_tree_on_a_plain_ground_is_what_differs_from_the_border() -> None:
    found = AutoMask()(picture(lollipop(ground=(235, 240, 250))))
    assert found.method == "colour"
    assert class_agreement(found.mask) > 0.95


def test_autumn_leaves_are_foliage() -> None:
    assert class_agreement(ColourMask()(picture(lollipop(crown=(235, 110, 20)))).mask) > 0.95


def test_a_silhouette_is_split_by_geometry() -> None:
    found = AutoMask()(picture(lollipop("black", "black")))
    assert found.method == "sketch"
    assert "silhouette" in found.why
    assert class_agreement(found.mask) > 0.9


def test_a_line_sketch_is_filled() -> None:
    found = AutoMask()(picture(lollipop("white", "white", outline="black")))
    assert found.method == "sketch"
    assert "line sketch" in found.why
    assert class_agreement(found.mask) > 0.9


def test_gaps_in_a_sketched_outline_are_closed() -> None:
    image = lollipop("white", "white", outline="black")
    ImageDraw.Draw(image).rectangle((146, 18, 149, 26), fill="white")
    assert class_agreement(SketchMask(gap=0.01)(picture(image)).mask) > 0.9


def test_a_sketch_with_a_transparent_ground_is_a_sketch() -> None:
    image = lollipop("white", "white", outline="black")
    found = AutoMask()(picture(image, opaque(image)))
    assert found.method == "sketch"
    assert class_agreement(found.mask) > 0.9


def bare_tree() -> Image.Image:
    """A black tree that forks into three, five times, without leaves."""
    image = Image.new("RGB", (400, 400), "white")
    draw = ImageDraw.Draw(image)

    def grow(x: float, y: float, angle: float, length: float, width: float, forks: int) -> None:
        end = x + length * math.sin(angle), y - length * math.cos(angle)
        draw.line((x, y, *end), fill="black", width=max(1, round(width)))
        for turn in (-0.5, 0.1, 0.55) if forks else ():
            grow(*end, angle + turn, 0.72 * length, 0.62 * width, forks - 1)

    grow(200, 390, 0, 100, 16, 5)
    return image


def test_a_leafless_tree_is_all_branch() -> None:
    mask = AutoMask()(picture(bare_tree())).mask
    assert (mask == BRANCH).mean() > 0.1
    assert not (mask == FOLIAGE).any()


def test_a_sketch_of_mere_strokes_is_all_branch() -> None:
    image = Image.new("RGB", (300, 400), "white")
    draw = ImageDraw.Draw(image)
    draw.line((150, 390, 150, 40), fill="black", width=10)
    for y in range(60, 260, 25):
        draw.line((150, y + 60, 60, y), fill="black", width=4)
        draw.line((150, y + 60, 240, y), fill="black", width=4)
    mask = SketchMask()(picture(image)).mask
    assert (mask == BRANCH).any()
    assert not (mask == FOLIAGE).any()


def test_gaps_in_a_crown_stay_background() -> None:
    image = lollipop()
    ImageDraw.Draw(image).ellipse((100, 80, 120, 100), fill="white")
    mask = AutoMask()(picture(image, opaque(image))).mask
    assert mask[90, 110] == BACKGROUND


def test_alpha_is_asked_of_a_picture_without_it() -> None:
    with pytest.raises(PictureError, match="needs a picture with transparent parts; use mask=auto"):
        AlphaMask()(picture(lollipop()))


@pytest.mark.parametrize("size", [(1, 1), (64, 64), (2, 500)])
@pytest.mark.parametrize("extractor", [AutoMask(), ColourMask(), SketchMask()])
def test_tiny_and_one_coloured_pictures_are_refused(size: tuple[int, int], extractor: AutoMask) -> None:
    with pytest.raises(PictureError, match=r"too small|of one colour"):
        extractor(picture(Image.new("RGB", size, (40, 150, 50))))


def test_settings_out_of_range_are_refused() -> None:
    with pytest.raises(ValidationError, match="less than 1"):
        SketchMask(ink=1.5)


def test_large_pictures_get_a_mask_of_their_own_size() -> None:
    large = lollipop().resize((1500, 2000))
    found = ColourMask()(picture(large))
    assert found.mask.shape == (2000, 1500)
    assert found.mask.dtype == np.uint8
