"""Both ways of GEGen's buds to see the space around them: samples, and the markers of space colonisation."""

from __future__ import annotations

import math
from functools import cache

import pytest

from generators.gegen import GEGen, gegen
from generators.gegen.markers import AHEAD, MARKER, REACH, TAKEN, cube_of, marker_at
from tests.generators.test_contract import plants
from treefit.plant import Budget, Plant, check_plant
from treefit.plant.contract import same
from treefit.plant.streams import child_key, seed_key

SEED = 5
Cube = tuple[int, int, int]
Place = tuple[float, float, float]


@cache
def marker(cube: Cube) -> Place:
    """Marker of a cube in a tree of SEED, in internodes."""
    number = cube_of.py_func(*cube)
    x, y, z = marker_at.py_func(child_key(child_key(seed_key(SEED), 0), MARKER), number, *cube)
    return float(x), float(y), float(z)


def near(place: Place, reach: float) -> set[Cube]:
    """Cubes above the ground whose markers are nearer to `place` than `reach`."""
    ranges = [range(math.floor(x - reach), math.floor(x + reach) + 1) for x in place]
    cubes = {(i, j, k) for i in ranges[0] for j in ranges[1] for k in ranges[2] if k >= 0}
    return {cube for cube in cubes if math.dist(marker(cube), place) < reach}


def grown_without_a_free_marker(plant: Plant, trunk: int) -> int:
    """Joints beyond the first `trunk` whose bud can have seen no marker that the joints before have not taken.

    Directions of the buds of new axes are not known: these may have seen markers anywhere around.
    """
    taken: set[Cube] = set()
    count = 0
    places = [(float(x), float(y), float(z)) for x, y, z in plant.position]
    for i in range(1, plant.n_vertices):
        bud = plant.parent[i]
        seen = near(places[bud], REACH + 1e-3) - taken
        if plant.level[i] == plant.level[bud] and bud > 0:
            seen = {cube for cube in seen if is_ahead(marker(cube), places[bud], places[plant.parent[bud]])}
        count += i > trunk and not seen
        taken |= near(places[i], TAKEN - 1e-3)
    return count


def is_ahead(place: Place, bud: Place, before: Place) -> bool:
    """Whether `place` is in the cone that a bud sees, which grew from `before`."""
    ahead = sum((x - y) * (y - z) for x, y, z in zip(place, bud, before, strict=True))
    return ahead > (AHEAD - 1e-3) * math.dist(place, bud) * math.dist(bud, before)


def test_a_bud_without_a_free_marker_does_not_grow() -> None:
    values = {**GEGen().space.complete({}), "internode": 1.0, "shedding": 0.0, "shade": 0.0}
    by_markers, by_samples = (
        gegen(space=space)({**values, "internodes": 1500}, SEED, Budget()) for space in ("markers", "sampled")
    )
    trunk = round(float(values["trunk"]) * float(values["leader"])) + 1
    assert by_markers.n_vertices > 400
    assert grown_without_a_free_marker(by_markers, trunk) == 0
    assert grown_without_a_free_marker(by_samples, trunk) > 0


@pytest.mark.parametrize("space", ["sampled", "markers"])
def test_random_plants_are_valid_and_the_same_when_grown_again(space: str) -> None:
    one, two = plants(gegen(space=space), 40), plants(gegen(space=space), 40)
    for plant, again in zip(one, two, strict=True):
        check_plant(plant)
        assert same(plant, again)


def test_the_setting_changes_the_plant() -> None:
    assert not any(same(*pair) for pair in zip(plants(gegen(), 5), plants(gegen(space="markers"), 5), strict=True))


def test_a_space_of_another_name_is_refused() -> None:
    with pytest.raises(ValueError, match="space: must be sampled or markers, got 'marker'"):
        gegen(space="marker")
