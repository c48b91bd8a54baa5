"""What surrounds a tree of GEGen: ground, obstacles, shade, neighbours, the way of the light."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from generators.gegen import Environment, GEGen, gegen
from generators.gegen.field import CELLS, HIGH, WIDE
from generators.gegen.voxels import coverage
from treefit.plant import Budget, Plant, Value
from treefit.plant.contract import same

BUDGET = Budget(6_000, 12_000)
FREE: Mapping[str, Value] = {
    "neighbour_left": 0.0,
    "neighbour_right": 0.0,
    "light_right": 0.0,
    "lean": 0.0,
    "bend": 0.0,
}
Points = NDArray[np.float64]  # (m, 3) in heights

WALL = {"from": [0.12, -1, 0], "to": [0.124, 1, 1.3]}
ROOF = {"from": [-0.1, -0.1, 0.4], "to": [0.1, 0.1, 0.45], "shade": 0}
POSTS = [{"from": [x - 0.02, y - 0.02, 0], "to": [x + 0.02, y + 0.02, 1]} for x in (-0.13, 0.13) for y in (-0.13, 0.13)]


def grown(generator: GEGen, count: int = 16, **values: Value) -> list[tuple[Plant, float]]:
    """Plants of random genomes, each with its nominal height in metres."""
    genomes = np.random.default_rng(8).random((count, len(generator.space)))
    told = [{**generator.space.decode(genome), **FREE, **values} for genome in genomes]
    return [(generator(each, 1, BUDGET), float(each["leader"]) * float(each["internode"])) for each in told]


def places(plant: Plant, height: float) -> Points:
    """Points along all segments and leaves, in heights."""
    child, leaf = plant.position[1:], plant.leaf_position
    part = np.linspace(0, 1, 9)[:, None, None]
    wood = child + part * (plant.position[plant.parent[1:]] - child)
    blades = leaf + part * plant.leaf_axis * plant.leaf_size[:, :1]
    return np.concatenate([wood.reshape(-1, 3), blades.reshape(-1, 3)]).astype(np.float64) / height


def leaves(plants: list[tuple[Plant, float]]) -> list[Points]:
    found = [plant.leaf_position.astype(np.float64) / height for plant, height in plants]
    return [points for points in found if len(points) > 20]


@pytest.fixture(scope="module")
def picture(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A frame of 120 by 60 pixels with a hole for the trunk, foot at the middle of its lower edge."""
    pixels = np.full((60, 120), 2, np.uint8)
    pixels[6:, 40:80] = 0
    pixels[30:34, 72:120] = 1
    path = tmp_path_factory.mktemp("mask") / "frame.png"
    Image.fromarray(pixels, mode="L").save(path)
    return path


@pytest.mark.parametrize("space", ["sampled", "markers"])
@pytest.mark.parametrize("boxes", [[WALL], [ROOF], POSTS], ids=["thin wall", "roof", "posts"])
def test_nothing_grows_into_a_box_or_below_the_ground(boxes: list[dict[str, object]], space: str) -> None:
    met = 0
    for plant, height in grown(gegen(environment=Environment(boxes=boxes), space=space)):
        points = places(plant, height)
        assert points[:, 2].min() > -1e-5
        for box in boxes:
            low, high = np.array(box["from"]) + 1e-6, np.array(box["to"]) - 1e-6
            assert not ((points > low) & (points < high)).all(axis=1).any()
    for plant, height in grown(gegen(space=space)):
        points = places(plant, height)
        met += any(((points > box["from"]) & (points < box["to"])).all(axis=1).any() for box in boxes)
    assert met > 4  # trees without these boxes do grow there


def test_nothing_grows_into_the_pixels_of_a_picture(picture: Path) -> None:
    environment = Environment(mask={"file": str(picture), "left": -0.6, "right": 0.6, "top": 0.6, "shade": 0})
    pixels = np.asarray(Image.open(picture)) > 0
    for plant, height in grown(GEGen(environment=environment)):
        points = places(plant, height)
        inside = (np.abs(points[:, 0]) < 0.6) & (np.abs(points[:, 1]) < 1.1) & (points[:, 2] < 0.6)
        columns = np.floor((points[inside, 0] + 0.6) * 100).astype(int)
        rows = 59 - np.floor(np.maximum(points[inside, 2], 0) * 100).astype(int)
        assert not pixels[rows, columns].any()


def test_a_tree_in_the_way_of_a_roof_grows_around_it() -> None:
    heights = [places(plant, height)[:, 2].max() for plant, height in grown(GEGen(environment={"boxes": [ROOF]}), 100)]
    assert np.mean(heights) > 0.5


@pytest.mark.parametrize(
    ("values", "boxes"),
    [
        ({"neighbour_right": 0.9, "gap": 0.15}, []),
        ({}, [{"from": [0.12, -1, 0], "to": [1, 1, 0.9], "solid": False}]),
        ({}, [WALL]),
    ],
    ids=["neighbour", "foliage", "wall"],
)
def test_shade_on_one_side_bends_and_thins_that_side(values: dict[str, Value], boxes: list[dict[str, object]]) -> None:
    free = leaves(grown(GEGen()))
    shaded = leaves(grown(GEGen(environment=Environment(boxes=boxes)), **values))
    assert np.mean([x[:, 0].mean() for x in shaded]) < np.mean([x[:, 0].mean() for x in free]) - 0.03
    assert np.mean([(x[:, 0] > 0).sum() for x in shaded]) < 0.7 * np.mean([(x[:, 0] > 0).sum() for x in free])


def test_a_tree_in_a_gap_is_slender_and_bare_below() -> None:
    def slenderness(points: Points) -> float:
        return float(points[:, 2].max() / np.ptp(np.quantile(points[:, 0], [0.05, 0.95])))

    free, in_gap = (
        leaves(grown(GEGen(), 200, trunk=0.1, neighbour_left=side, neighbour_right=side, gap=0.2))
        for side in (0.0, 0.9)
    )
    assert np.median([slenderness(x) for x in in_gap]) > 1.4 * np.median([slenderness(x) for x in free])
    low = [np.mean([np.quantile(x[:, 2], 0.05) / x[:, 2].max() for x in each]) for each in (free, in_gap)]
    assert low[1] > low[0] + 0.05


@pytest.mark.parametrize("axis", [0, 1])
def test_the_crown_leans_to_where_the_light_comes_from(axis: int) -> None:
    def middle(slope: float) -> float:
        light = [0.0, 0.0, 1.0]
        light[axis] = slope
        return float(np.mean([x[:, axis].mean() for x in leaves(grown(GEGen(environment=Environment(light=light))))]))

    assert middle(-0.6) < middle(0.0) < middle(0.6)


def test_an_empty_environment_is_no_environment() -> None:
    far = {"from": [1.5, -1, 0], "to": [2, 1, 1]}
    none = grown(GEGen())
    for environment in (Environment(), {}, {"boxes": [far]}, {"light": [0, 0, 5]}):
        again = grown(GEGen(environment=environment))
        assert all(same(one, two) for (one, _), (two, _) in zip(none, again, strict=True))


def test_voxels_hold_the_volume_of_a_thing(picture: Path) -> None:
    place = {"left": -0.31, "right": 0.47, "bottom": 0.13, "top": 0.9, "front": -0.2, "back": 0.33}
    framed = Environment(mask={"file": str(picture), **place}).things["environment.mask"]
    volume = 0.78 * 0.77 * 0.53
    share = (np.asarray(Image.open(picture)) > 0).mean()
    assert framed.pixels is not None
    assert coverage(framed).shape == (HIGH, WIDE, WIDE)
    assert coverage(framed).max() <= 1 + 1e-9
    assert coverage(framed).sum() / CELLS**3 == pytest.approx(volume * share)


def test_light_from_both_settings_adds_up_to_the_steepest() -> None:
    one = grown(GEGen(environment=Environment(light=[0.2, 0, 1])), 4, light_right=0.2)
    two = grown(GEGen(), 4, light_right=0.4)
    steep = grown(GEGen(environment=Environment(light=[0.7, 0, 1])), 4, light_right=0.6)
    steepest = grown(GEGen(), 4, light_right=0.7)
    assert all(same(a, b) for (a, _), (b, _) in zip(one + steep, two + steepest, strict=True))


BAD: list[tuple[object, str]] = [
    ({"light": [1, 0, 1]}, "environment.light: must come from above"),
    ({"light": [0, 0, 0]}, "environment.light: must come from above"),
    ({"light": [0, 1]}, "environment.light: must be 3 numbers, got"),
    ({"lihgt": [0, 0, 1]}, "environment.lihgt: no such setting; there are light, boxes, mask"),
    ({"boxes": {"from": [0, 0, 0]}}, "environment.boxes: must be a list"),
    ({"boxes": [[0, 0, 0]]}, r"environment.boxes\[0\]: must be {from"),
    ({"boxes": [WALL, {**WALL, "sold": True}]}, r"environment.boxes\[1\].sold: no such setting"),
    ({"boxes": [{**WALL, "solid": 1}]}, r"environment.boxes\[0\].solid: must be true or false"),
    ({"boxes": [{**WALL, "shade": -1}]}, r"environment.boxes\[0\].shade: must be at least 0"),
    ({"boxes": [{**WALL, "to": [0.1, 1, 1]}]}, r"environment.boxes\[0\]: from must be under to"),
    ({"boxes": [{**WALL, "from": [0.05, -1, 0]}]}, r"environment.boxes\[0\]: an obstacle must be 0.1 heights"),
    ({"mask": {"file": "nowhere.png", "left": 0.1, "right": 1, "top": 1}}, "environment.mask.file: no such file"),
    ({"mask": {"file": __file__, "left": 0.1, "right": 1, "top": 1}}, "environment.mask.file: cannot be read"),
    ({"mask": {"file": "x.png", "left": 1, "right": 0, "top": 1}}, "environment.mask: left must be under right"),
    ({"mask": {"file": "x.png", "left": "a", "right": 0, "top": 1}}, "environment.mask.left: must be a number"),
    ({"mask": "x.png"}, "environment.mask: must be {file"),
    ("dark", "environment: must be null or have"),
]


@pytest.mark.parametrize(("settings", "message"), BAD)
def test_a_wrong_environment_is_told_in_one_line(settings: Mapping[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message) as caught:
        GEGen(environment=settings)
    assert "\n" not in str(caught.value)


def test_a_picture_over_the_foot_of_the_trunk_or_without_anything_is_refused(picture: Path, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"environment\.mask: an obstacle must be"):
        Environment(mask={"file": str(picture), "left": -0.1, "right": 1, "top": 1})
    Image.new("L", (4, 4)).save(tmp_path / "black.png")
    with pytest.raises(ValueError, match="has no pixel that is not background"):
        Environment(mask={"file": str(tmp_path / "black.png"), "left": 0.2, "right": 1, "top": 1})
